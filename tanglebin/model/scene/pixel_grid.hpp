#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Points sorted by the pixel of the camera that saw them. Neighbours on a surface are found in nearby
/// pixels, whatever the order and density of the cloud.
class PixelGrid {
public:
  /// Takes points in metres, world frame. Points that do not project into the image are left out.
  PixelGrid(const std::vector<Eigen::Vector3f>& points, const Camera& camera);

  /// Consecutive points of one row, in metres; the first is (x[0], y[0], z[0]). Readers may read a few values
  /// past the last point; these are meaningless.
  struct Run {
    const float* x;
    const float* y;
    const float* z;
    int size;
    std::size_t first;  ///< index of the first point in the grid
  };

  /// The points in row-major pixel order: position, pixel, and index into the points passed to the
  /// constructor.
  std::size_t size() const { return indices_.size(); }
  Eigen::Vector3f point(std::size_t item) const { return {x_[item], y_[item], z_[item]}; }
  const std::vector<PixelPosition>& pixels() const { return pixels_; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  const Camera& camera() const { return camera_; }

  /// The points in columns first … last of a row. Columns and rows may lie outside the image. Inline: the
  /// axis method calls it for every row around every point.
  Run run(int row, int first, int last) const {
    first = std::max(first, left_);
    last = std::min(last, left_ + width_ - 1);
    if (row < top_ || row >= top_ + height_ || first > last) return no_run();
    const std::uint32_t begin = starts_[position_of({first, row})];
    const std::uint32_t end = starts_[position_of({last, row}) + 1];
    return {x_.data() + begin, y_.data() + begin, z_.data() + begin, static_cast<int>(end - begin), begin};
  }

  /// A run without points.
  Run no_run() const { return {x_.data(), y_.data(), z_.data(), 0, 0}; }

  /// The size in pixels of a length (m) at a point.
  double pixels_across(double length, const Eigen::Vector3f& point) const;

private:
  std::size_t position_of(const PixelPosition& pixel) const {
    return static_cast<std::size_t>(pixel.row - top_) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(pixel.column - left_);
  }

  Camera camera_;
  int left_ = 0;  // the part of the image that contains points
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<std::uint32_t> indices_;
  std::vector<PixelPosition> pixels_;
  std::vector<std::uint32_t> starts_;  // first point of each pixel; last entry: the number of points
};

}  // namespace tanglebin
