#include "tanglebin/model/pixel_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace tanglebin {
namespace {

/// A point and where it belongs.
struct Seen {
  PixelGrid::Pixel pixel;
  PixelGrid::Item item;
};

std::vector<Seen> seen_points(const std::vector<Eigen::Vector3f>& points, const Camera& camera) {
  std::vector<Seen> seen;
  seen.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Eigen::Vector2d> image = project(camera, points[i].cast<double>());
    if (!image) continue;
    const Eigen::Vector2d pixel = image->array().round();
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width && pixel.y() < camera.height))
      continue;
    seen.push_back({{static_cast<int>(pixel.x()), static_cast<int>(pixel.y())},
                    {points[i], static_cast<std::uint32_t>(i)}});
  }
  return seen;
}

}  // namespace

PixelGrid::PixelGrid(const std::vector<Eigen::Vector3f>& points, const Camera& camera) : camera_(camera) {
  const std::vector<Seen> seen = seen_points(points, camera);
  Eigen::AlignedBox2i part;
  for (const auto& [pixel, item] : seen) part.extend(Eigen::Vector2i(pixel.column, pixel.row));
  if (!part.isEmpty()) {
    left_ = part.min().x();
    top_ = part.min().y();
    width_ = part.sizes().x() + 1;
    height_ = part.sizes().y() + 1;
  }

  // Counting sort.
  starts_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1);
  for (const auto& [pixel, item] : seen) ++starts_[position_of(pixel) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::uint32_t> next = starts_;
  items_.resize(seen.size());
  pixels_.resize(seen.size());
  for (const auto& [pixel, item] : seen) {
    const std::uint32_t place = next[position_of(pixel)]++;
    items_[place] = item;
    pixels_[place] = pixel;
  }
}

std::span<const PixelGrid::Item> PixelGrid::run(int row, int first, int last) const {
  first = std::max(first, left_);
  last = std::min(last, left_ + width_ - 1);
  if (row < top_ || row >= top_ + height_ || first > last) return {};
  const std::uint32_t begin = starts_[position_of({first, row})];
  const std::uint32_t end = starts_[position_of({last, row}) + 1];
  return std::span(items_).subspan(begin, end - begin);
}

double PixelGrid::pixels_across(double length, const Eigen::Vector3f& point) const {
  const double depth = camera_.pose.linear().col(2).dot(point.cast<double>() - camera_.pose.translation());
  return length * std::max(camera_.fx, camera_.fy) / depth;
}

std::size_t PixelGrid::position_of(const Pixel& pixel) const {
  return static_cast<std::size_t>(pixel.row - top_) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(pixel.column - left_);
}

}  // namespace tanglebin
