#include "tanglebin/model/scene/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace tanglebin {

RangeImage::RangeImage(const PointCloud& cloud, const Camera& camera)
    : camera_(camera),
      depths_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
              std::numeric_limits<float>::infinity()) {
  for (const Eigen::Vector3f& point : cloud.points) {
    if (!point.allFinite()) continue;
    const std::optional<PixelPosition> pixel = pixel_of(camera, point.cast<double>());
    if (!pixel) continue;
    float& nearest = depths_[static_cast<std::size_t>(pixel->row) * static_cast<std::size_t>(camera.width) +
                             static_cast<std::size_t>(pixel->column)];
    nearest = std::min(nearest, static_cast<float>(depth_of(camera, point.cast<double>())));
  }
}

bool RangeImage::hides(const Eigen::Vector3d& first, const Eigen::Vector3d& second, int radius) const {
  const std::optional<Eigen::Vector2d> first_image = project(camera_, first);
  const std::optional<Eigen::Vector2d> second_image = project(camera_, second);
  if (!first_image || !second_image) return false;
  const Eigen::Vector2d middle = (*first_image + *second_image) / 2;
  const double farther = std::max(depth_of(camera_, first), depth_of(camera_, second));

  const auto clamped = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size - 1)));
  };
  const int left = clamped(std::round(middle.x()) - radius, camera_.width);
  const int right = clamped(std::round(middle.x()) + radius, camera_.width);
  const int top = clamped(std::round(middle.y()) - radius, camera_.height);
  const int bottom = clamped(std::round(middle.y()) + radius, camera_.height);
  for (int v = top; v <= bottom; ++v) {
    const auto row = depths_.begin() + static_cast<std::ptrdiff_t>(v) * camera_.width;
    if (std::any_of(row + left, row + right + 1, [&](float depth) { return depth < farther; })) return true;
  }
  return false;
}

bool RangeImage::shows_empty(const Eigen::Vector3d& axis, double radius) const {
  const std::optional<Eigen::Vector2d> image = project(camera_, axis);
  if (!image) return false;
  const double depth = depth_of(camera_, axis);
  const int window = std::max(1, static_cast<int>(radius * camera_.fx / depth / 3));
  const Eigen::Vector2d pixel = image->array().round();
  const int column = static_cast<int>(pixel.x());
  const int row = static_cast<int>(pixel.y());
  float nearest = std::numeric_limits<float>::infinity();
  for (int v = std::max(0, row - window); v <= std::min(camera_.height - 1, row + window); ++v) {
    for (int u = std::max(0, column - window); u <= std::min(camera_.width - 1, column + window); ++u) {
      nearest =
          std::min(nearest, depths_[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
                                    static_cast<std::size_t>(u)]);
    }
  }
  return std::isfinite(nearest) && nearest > depth - radius / 2;
}

}  // namespace tanglebin
