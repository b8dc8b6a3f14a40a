#include "tanglebin/model/scene/pixel_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace tanglebin {
namespace {

// Number of floats that readers of a run may read past its last point.
constexpr std::size_t read_behind = 4;

/// A point's index and pixel.
struct PointInPixel {
  PixelPosition pixel;
  std::uint32_t index;
};

std::vector<PointInPixel> seen_points(const std::vector<Eigen::Vector3f>& points, const Camera& camera) {
  std::vector<PointInPixel> seen;
  seen.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<SeenPixel> pixel = seen_pixel(camera, points[i].cast<double>());
    if (pixel) seen.push_back({pixel->pixel, static_cast<std::uint32_t>(i)});
  }
  return seen;
}

}  // namespace

PixelGrid::PixelGrid(const std::vector<Eigen::Vector3f>& points, const Camera& camera) : camera_(camera) {
  const std::vector<PointInPixel> seen = seen_points(points, camera);
  Eigen::AlignedBox2i part;
  for (const auto& [pixel, index] : seen) part.extend(Eigen::Vector2i(pixel.column, pixel.row));
  if (!part.isEmpty()) {
    left_ = part.min().x();
    top_ = part.min().y();
    width_ = part.sizes().x() + 1;
    height_ = part.sizes().y() + 1;
  }

  // Counting sort.
  starts_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1);
  for (const auto& [pixel, index] : seen) ++starts_[position_of(pixel) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::uint32_t> next = starts_;
  for (std::vector<float>* coordinate : {&x_, &y_, &z_}) coordinate->resize(seen.size() + read_behind);
  indices_.resize(seen.size());
  pixels_.resize(seen.size());
  for (const auto& [pixel, index] : seen) {
    const std::uint32_t place = next[position_of(pixel)]++;
    x_[place] = points[index].x();
    y_[place] = points[index].y();
    z_[place] = points[index].z();
    indices_[place] = index;
    pixels_[place] = pixel;
  }
}

double PixelGrid::pixels_across(double length, const Eigen::Vector3f& point) const {
  constexpr double most = 1e6;
  return std::min(most, length * std::max(camera_.fx, camera_.fy) / depth_of(camera_, point.cast<double>()));
}

}  // namespace tanglebin
