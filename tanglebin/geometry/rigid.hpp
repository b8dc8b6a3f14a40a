#pragma once

#include <Eigen/Geometry>

namespace tanglebin {

/// Whether a pose is a rigid motion: finite numbers, and a rotation to within 1e-6.
inline bool is_rigid(const Eigen::Isometry3d& pose) {
  constexpr double tolerance = 1e-6;
  return pose.matrix().allFinite() && pose.linear().isUnitary(tolerance) && pose.linear().determinant() > 0;
}

}  // namespace tanglebin
