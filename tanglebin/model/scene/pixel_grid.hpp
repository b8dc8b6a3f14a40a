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

  /// Consecutive points of one row.
  struct Run {
    std::size_t first = 0;  ///< index of the first point in the grid
    std::size_t size = 0;
  };

  /// A rectangular part of the image.
  class Window {
  public:
    int first_row() const { return first_row_; }
    int rows() const { return rows_; }

    /// The points in a row of the image that are in the window. Inline: the axis method calls it for every
    /// row around every point.
    Run row(int row) const {
      const int number = row - first_row_;
      if (number < 0 || number >= rows_) return {};
      const std::uint32_t* start = start_ + number * stride_;
      return {start[0], start[columns_] - start[0]};
    }

  private:
    friend class PixelGrid;

    const std::uint32_t* start_ = nullptr;  // of PixelGrid::starts_, for the first pixel
    std::ptrdiff_t stride_ = 0;             // from row to row
    int first_row_ = 0;
    int rows_ = 0;
    int columns_ = 0;
  };

  /// The points in row-major pixel order: position, pixel, and index into the points passed to the
  /// constructor.
  std::size_t size() const { return indices_.size(); }
  Eigen::Vector3f point(std::size_t item) const { return {x_[item], y_[item], z_[item]}; }
  const std::vector<PixelPosition>& pixels() const { return pixels_; }

  /// The points' coordinates, m. Readers may read a few values past the last point; these are meaningless.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  const Camera& camera() const { return camera_; }

  /// The part of the image that is up to `reach` pixels from a pixel, to each side. The pixel may lie outside
  /// of the image.
  Window window(PixelPosition middle, int reach) const {
    const int left = std::max(middle.column - reach, left_);
    const int right = std::min(middle.column + reach, left_ + width_ - 1);
    const int top = std::max(middle.row - reach, top_);
    const int bottom = std::min(middle.row + reach, top_ + height_ - 1);
    Window window;
    if (left > right || top > bottom) return window;
    window.start_ = starts_.data() + position_of({left, top});
    window.stride_ = width_;
    window.first_row_ = top;
    window.rows_ = bottom - top + 1;
    window.columns_ = right - left + 1;
    return window;
  }

  /// The size in pixels of a length (m) at a point; at most a million, which is more than any image has.
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
