#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// How far the camera saw through each of its pixels, from a cloud that it took.
class RangeImage {
public:
  RangeImage(const PointCloud& cloud, const Camera& camera);

  /// Whether something nearer than the farther of two points (m, world frame) was seen around the midpoint of
  /// their projections: within `radius` pixels of it. False where they are not in front of the camera.
  bool hides(const Eigen::Vector3d& first, const Eigen::Vector3d& second, int radius) const;

  /// Whether the camera looked past the axis of a tube of this radius (m) here: around it, within a third of
  /// a radius, something was seen, and all of it is behind the tube's surface.
  bool shows_empty(const Eigen::Vector3d& axis, double radius) const;

private:
  Camera camera_;
  std::vector<float> depths_;  ///< m, of the nearest point, row by row; ∞ where there is none
};

}  // namespace tanglebin
