#include "tanglebin/scene/image_of_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// About ten thousand finite points, spread over the cloud.
std::vector<Vector3d> some_points(const PointCloud& cloud) {
  constexpr std::size_t most = 10000;
  const auto finite = static_cast<std::size_t>(
      std::ranges::count_if(cloud.points, [](const Eigen::Vector3f& point) { return point.allFinite(); }));
  const std::size_t step = std::max<std::size_t>(1, finite / most);
  std::vector<Vector3d> points;
  std::size_t count = 0;
  for (const Eigen::Vector3f& point : cloud.points) {
    if (point.allFinite() && count++ % step == 0) points.emplace_back(point.cast<double>());
  }
  return points;
}

/// The line pixel = focal length · slope + principal point through a cloud's pixels, by least squares.
class Line {
public:
  void add(double slope, double pixel) {
    ++count_;
    slope_ += slope;
    pixel_ += pixel;
    squares_ += slope * slope;
    products_ += slope * pixel;
    pixels_ += pixel * pixel;
  }

  double count() const { return count_; }
  double focal_length() const { return (products_ - slope_ * pixel_ / count_) / spread(); }
  double principal_point() const { return (pixel_ - focal_length() * slope_) / count_; }

  /// The pixels' standard deviation.
  double deviation() const { return std::sqrt(std::max(0.0, pixels_ - pixel_ * pixel_ / count_) / count_); }

  /// Pixels², the mean square of what is left.
  double mean_square() const {
    const double left = pixels_ - pixel_ * pixel_ / count_ - focal_length() * focal_length() * spread();
    return std::max(0.0, left) / count_;
  }

private:
  double spread() const { return squares_ - slope_ * slope_ / count_; }

  double count_ = 0;
  double slope_ = 0;
  double pixel_ = 0;
  double squares_ = 0;
  double products_ = 0;
  double pixels_ = 0;
};

}  // namespace

std::optional<FittedIntrinsics> fit_intrinsics(const PointCloud& cloud, const Eigen::Isometry3d& motion) {
  Line across;
  Line down;
  std::size_t finite = 0;
  constexpr std::size_t most = 1U << 18U;
  const std::size_t step = cloud.points.size() / most + 1;
  for (std::size_t i = 0; i < cloud.points.size(); i += step) {
    if (!cloud.points[i].allFinite()) continue;
    ++finite;
    const Vector3d point = motion * cloud.points[i].cast<double>();
    constexpr double steepest = 10;  // a slope beyond is no image's, and would outweigh all others
    const Vector3d slope = point / point.z();
    if (!(point.z() > 0) || slope.head<2>().cwiseAbs().maxCoeff() > steepest) continue;
    across.add(slope.x(), static_cast<double>(i % cloud.width));
    const std::size_t row = i / cloud.width;
    down.add(slope.y(), static_cast<double>(row));
  }
  constexpr double points_min = 100;
  constexpr double share_min = 0.9;
  constexpr double deviation_min = 5;  // pixels
  if (across.count() < std::max(points_min, share_min * static_cast<double>(finite)) ||
      std::min(across.deviation(), down.deviation()) < deviation_min)
    return std::nullopt;
  return FittedIntrinsics{.intrinsics = {.width = static_cast<int>(cloud.width),
                                         .height = static_cast<int>(cloud.height),
                                         .fx = across.focal_length(),
                                         .fy = down.focal_length(),
                                         .cx = across.principal_point(),
                                         .cy = down.principal_point()},
                          .residual = std::sqrt(across.mean_square() + down.mean_square())};
}

bool is_image(const FittedIntrinsics& fitted) {
  constexpr double share = 0.005;
  return fitted.residual <= share * std::hypot(fitted.intrinsics.width, fitted.intrinsics.height);
}

bool fits(const FittedIntrinsics& fitted) {
  return is_image(fitted) && fitted.intrinsics.fx > 0 && fitted.intrinsics.fy > 0;
}

double share_in_image(const PointCloud& cloud, const Eigen::Affine3d& motion, const Intrinsics& intrinsics) {
  const Camera camera = camera_with(intrinsics, Eigen::Isometry3d::Identity());
  const std::vector<Vector3d> points = some_points(cloud);
  const auto is_seen = [&](const Vector3d& point) { return pixel_of(camera, motion * point).has_value(); };
  const auto seen = std::ranges::count_if(points, is_seen);
  return points.empty() ? 0 : static_cast<double>(seen) / static_cast<double>(points.size());
}

double share_behind(const PointCloud& cloud, const Eigen::Isometry3d& motion) {
  const std::vector<Vector3d> points = some_points(cloud);
  constexpr double far = 20;
  const auto behind = std::ranges::count_if(points, [&](const Vector3d& point) {
    const double depth = (motion * point).z();
    return depth < 0 && depth > -far;
  });
  return points.empty() ? 0 : static_cast<double>(behind) / static_cast<double>(points.size());
}

std::optional<double> extent(const PointCloud& cloud) {
  const std::vector<Vector3d> points = some_points(cloud);
  if (points.empty()) return std::nullopt;
  constexpr std::size_t hundred = 100;
  const auto cut = static_cast<std::ptrdiff_t>(points.size() / hundred);
  double longest = 0;
  for (const Eigen::Index axis : {0, 1, 2}) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const Vector3d& point : points) values.push_back(point[axis]);
    std::ranges::nth_element(values, values.begin() + cut);
    const double low = values[static_cast<std::size_t>(cut)];
    std::ranges::nth_element(values, values.end() - 1 - cut);
    longest = std::max(longest, *(values.end() - 1 - cut) - low);
  }
  return longest;
}

}  // namespace tanglebin
