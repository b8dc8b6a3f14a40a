#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Points sorted by the pixels of the camera that saw them: what is beside a point on a surface is around its
/// pixel, whatever the order and density of the cloud.
class PixelGrid {
public:
  /// Points in metres, world frame. Those that do not project into the image are left out.
  PixelGrid(const std::vector<Eigen::Vector3f>& points, const Camera& camera);

  /// Points in metres, pixel after pixel and row after row: the first is at x[0], y[0], z[0]. A few more of
  /// each coordinate may be read behind the last one, which mean nothing.
  struct Run {
    const float* x;
    const float* y;
    const float* z;
    int size;
    std::size_t first;  ///< the number of the first in the grid
  };

  /// The points of the grid, pixel after pixel and row after row: place, pixel, and index into the points
  /// that the grid was made of.
  std::size_t size() const { return indices_.size(); }
  Eigen::Vector3f point(std::size_t item) const { return {x_[item], y_[item], z_[item]}; }
  const std::vector<PixelPosition>& pixels() const { return pixels_; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }

  const Camera& camera() const { return camera_; }

  /// The points in columns first … last of a row; columns and rows may be beyond the image.
  Run run(int row, int first, int last) const;

  /// How many pixels wide a length (m) appears at a point.
  double pixels_across(double length, const Eigen::Vector3f& point) const;

private:
  std::size_t position_of(const PixelPosition& pixel) const;

  Camera camera_;
  int left_ = 0;  // the part of the image that has points
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<std::uint32_t> indices_;
  std::vector<PixelPosition> pixels_;
  std::vector<std::uint32_t> starts_;  // where each pixel's points begin; at last the number of points
};

}  // namespace tanglebin
