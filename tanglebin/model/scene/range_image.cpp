#include "tanglebin/model/scene/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace tanglebin {

RangeImage::RangeImage(const std::vector<Eigen::Vector3f>& points, const Camera& camera,
                       std::vector<Eigen::AlignedBox3d> solid)
    : camera_(camera),
      solid_(std::move(solid)),
      end_row_(camera.height),
      depths_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
              std::numeric_limits<float>::infinity()) {
  for (const Eigen::Vector3f& point : points) add(point);
}

void RangeImage::add(const Eigen::Vector3f& point) {
  const std::optional<SeenPixel> seen = seen_pixel(camera_, point.cast<double>());
  if (!seen) return;
  const auto [column, row] = seen->pixel;
  float& nearest = depths_[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width) +
                           static_cast<std::size_t>(column)];
  nearest = std::min(nearest, static_cast<float>(seen->depth));
}

void RangeImage::keep_measured_rows() {
  const auto is_measured = [](float depth) { return std::isfinite(depth); };
  const auto width = static_cast<std::ptrdiff_t>(camera_.width);
  const auto first = std::ranges::find_if(depths_, is_measured);
  const auto last = std::find_if(depths_.rbegin(), depths_.rend(), is_measured).base();
  first_row_ = (first - depths_.begin()) / width;
  end_row_ = first == depths_.end() ? first_row_ : (last - depths_.begin() + width - 1) / width;
  depths_ = std::vector<float>(depths_.begin() + first_row_ * width, depths_.begin() + end_row_ * width);
}

RangeImage::Seen RangeImage::seen_around(const Eigen::Vector2d& middle, double reach, double near) const {
  // Compared as doubles: the projection of a point beside a near camera may be a number that no integer
  // holds.
  const auto between = [](double value, std::ptrdiff_t first, std::ptrdiff_t end) {
    return static_cast<std::ptrdiff_t>(
        std::clamp(value, static_cast<double>(first), static_cast<double>(end)));
  };
  const auto left = between(std::round(middle.x()) - reach, 0, camera_.width);
  const auto right = between(std::round(middle.x()) + reach + 1, 0, camera_.width);  // one past the last
  const auto top = between(std::round(middle.y()) - reach, first_row_, end_row_);
  const auto bottom = between(std::round(middle.y()) + reach + 1, first_row_, end_row_);
  const auto limit = static_cast<float>(near);
  int nearer = 0;
  int measured = 0;
  for (auto v = top; v < bottom && nearer == 0; ++v) {
    const float* row = depths_.data() + (v - first_row_) * camera_.width;
    for (auto u = left; u < right; ++u) {
      nearer += row[u] < limit ? 1 : 0;
      measured += row[u] < std::numeric_limits<float>::infinity() ? 1 : 0;
    }
  }
  if (nearer > 0) return Seen::nearer;
  return measured > 0 ? Seen::farther : Seen::nothing;
}

bool RangeImage::hides(const Eigen::Vector3d& first, const Eigen::Vector3d& second, int radius) const {
  const std::optional<Eigen::Vector2d> first_image = project(camera_, first);
  const std::optional<Eigen::Vector2d> second_image = project(camera_, second);
  if (!first_image || !second_image) return false;
  const Eigen::Vector2d middle = (*first_image + *second_image) / 2;
  const double depth = std::max(depth_of(camera_, first), depth_of(camera_, second));
  return seen_around(middle, radius, depth) == Seen::nearer;
}

bool RangeImage::is_solid(const Eigen::Vector3d& axis, double radius) const {
  return std::ranges::any_of(solid_, [&](const Eigen::AlignedBox3d& part) {
    return part.squaredExteriorDistance(axis) < radius * radius / 4;
  });
}

bool RangeImage::shows_empty(const Eigen::Vector3d& axis, double radius) const {
  if (is_solid(axis, radius)) return true;
  const std::optional<Eigen::Vector2d> image = project(camera_, axis);
  if (!image) return false;
  const double depth = depth_of(camera_, axis);
  const double reach = std::max(1.0, std::floor(radius * camera_.fx / depth / 3));
  return seen_around(*image, reach, depth - radius / 2) == Seen::farther;
}

bool RangeImage::covers(const Eigen::Vector3d& point, double radius) const {
  const std::optional<Eigen::Vector2d> image = project(camera_, point);
  if (!image) return false;
  const double depth = depth_of(camera_, point);
  const Eigen::Array2d size(camera_.width - 1, camera_.height - 1);
  const Eigen::Array2d margin = Eigen::Array2d(camera_.fx, camera_.fy) * radius / depth;
  return (image->array() >= margin).all() && (image->array() <= size - margin).all();
}

}  // namespace tanglebin
