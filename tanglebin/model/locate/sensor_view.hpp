#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

// Internal to the room.
namespace tanglebin {

/// What the camera saw in each pixel, in the camera's own frame.
struct SensorView {
  Camera camera;                        ///< its pose is the identity
  std::vector<Eigen::Vector3f> points;  ///< m, camera frame, row by row; NaN where nothing was seen
  std::vector<std::size_t> seen;        ///< the pixels with a point, ascending

  /// The point of a pixel, which may lie outside of the image; NaN where nothing was seen.
  Eigen::Vector3f at(int column, int row) const;

  /// At most about `count` of the seen pixels, spread evenly over them.
  std::vector<std::size_t> sample(std::size_t count) const;

  /// The size of a pixel at this depth: m.
  double pixel_size(double depth) const { return depth / camera.fx; }
};

/// The view of a cloud (m, world frame). Of several points in one pixel, the nearest stays; single points far
/// in front of or behind all around them are left out. Throws InputError if less than half of the points, or
/// fewer than a thousand, are in the camera's image.
SensorView view_of(const PointCloud& cloud, const Camera& camera);

}  // namespace tanglebin
