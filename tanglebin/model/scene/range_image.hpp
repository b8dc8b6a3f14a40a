#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// The range that the camera measured in each pixel, from a cloud that it took.
class RangeImage {
public:
  RangeImage(const PointCloud& cloud, const Camera& camera);

  /// True if the camera saw something nearer than the farther of two points (m, world frame) within `radius`
  /// pixels of the midpoint of their projections. False if a point is not in front of the camera.
  bool hides(const Eigen::Vector3d& first, const Eigen::Vector3d& second, int radius) const;

  /// True if the camera looked past the axis of a tube of this radius (m) at this point: within a third of a
  /// radius around it, something was seen, and all of it lies behind the tube's surface.
  bool shows_empty(const Eigen::Vector3d& axis, double radius) const;

private:
  Camera camera_;
  std::vector<float> depths_;  ///< m, of the nearest point, row by row; ∞ where there is none
};

}  // namespace tanglebin
