#include "tanglebin/model/floor_check.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/stride.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// The points near the floor that are on no tube, m, in the support's frame, by the square of it they are in.
class FloorSquares {
public:
  // A square is two tubes wide, so that what is left of one tube does not fill it.
  explicit FloorSquares(double radius) : radius_(radius), width_(4 * radius) {}

  void add(const Vector3d& point) {
    squares_[{std::lround(point.x() / width_), std::lround(point.y() / width_)}].push_back(point);
  }

  // m, of the points in the squares that look like floor.
  std::vector<double> heights() const {
    std::vector<double> heights;
    for (const auto& [place, points] : squares_) {
      if (!is_floor(points)) continue;
      for (const Vector3d& point : points) heights.push_back(point.z());
    }
    return heights;
  }

private:
  // Whether the points are level, flat, and all over the square.
  bool is_floor(const std::vector<Vector3d>& points) const {
    constexpr std::size_t least = 8;
    if (points.size() < least) return false;
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& point : points) mean += point;
    mean /= static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector3d& point : points) covariance += (point - mean) * (point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance /
                                                              static_cast<double>(points.size()));
    const Vector3d spread = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
    const double most_oblique = std::cos(5 * degree);
    constexpr double thickest = 0.2;   // radii; where a tube is seen from above, it is 0.22
    constexpr double narrowest = 0.2;  // widths; all over a square, it is 0.29, and a tube in it 0.14
    return std::abs(axes.eigenvectors().col(0).z()) > most_oblique && spread[0] < thickest * radius_ &&
           spread[1] > narrowest * width_;
  }

  double radius_;  // m
  double width_;   // m, of a square
  std::map<std::pair<long, long>, std::vector<Vector3d>> squares_;
};

std::vector<double> heights_of_floor(const PointCloud& cloud, const KnownScene& known, const Model& model,
                                     std::size_t stride) {
  const Support& support = known.support;
  const Eigen::Isometry3d to_support = support.pose.inverse(Eigen::Isometry);
  const double radius = std::ranges::max(known.kinds, {}, &TubeKind::radius).radius;
  const double reach = std::max(0.02, radius);
  FloorSquares squares(radius);
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (!cloud.points[i].allFinite() || model.labels[i] > bin_label) continue;
    const Vector3d point = to_support * cloud.points[i].cast<double>();
    const bool is_over_it =
        support.shape == Support::Shape::plane || is_over_floor(support.bin, point, reach);
    if (is_over_it && std::abs(point.z()) < reach) squares.add(point);
  }
  return squares.heights();
}

// Where most of the heights are, to within their scatter.
std::optional<double> peak_of(const std::vector<double>& heights) {
  constexpr double step = 0.001;  // m
  std::map<int, std::size_t> counts;
  for (const double height : heights) ++counts[static_cast<int>(std::lround(height / step))];
  const auto highest = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
  const double peak = highest->first * step;
  std::vector<double> around;
  for (const double height : heights) {
    if (std::abs(height - peak) < 2 * step) around.push_back(height);
  }
  if (2 * around.size() < heights.size()) return std::nullopt;
  return median(std::move(around));
}

}  // namespace

std::optional<Finding> doubt_of_floor_height(const PointCloud& cloud, const KnownScene& known,
                                             const Model& model) {
  constexpr std::size_t wanted = 50'000;
  constexpr std::size_t least = 200;
  constexpr std::size_t share = 20;
  const std::size_t stride = sampling_stride(cloud.points.size(), wanted);
  const std::vector<double> heights = heights_of_floor(cloud, known, model, stride);
  if (heights.size() < std::max(least, cloud.points.size() / stride / share)) return std::nullopt;
  const std::optional<double> height = peak_of(heights);
  constexpr double tolerance = 0.0025;
  if (!height || std::abs(*height) <= tolerance + known.support.margin) return std::nullopt;
  return Finding{Finding::Severity::warning, "floor",
                 fmt::format("the floor is {:.1f} mm {} where the scene has it: the support's pose is off",
                             1000 * std::abs(*height), *height > 0 ? "above" : "below")};
}

}  // namespace tanglebin
