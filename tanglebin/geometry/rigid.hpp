#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace tanglebin {

/// Whether a pose is a rigid motion: finite numbers, and a rotation to within 1e-6.
inline bool is_rigid(const Eigen::Isometry3d& pose) {
  constexpr double tolerance = 1e-6;
  return pose.matrix().allFinite() && pose.linear().isUnitary(tolerance) && pose.linear().determinant() > 0;
}

/// The rigid motion that a 4 x 4 matrix stands for. None if its rotation is off by more than 0.001, as
/// rounded numbers never are, if its last row is not 0, 0, 0, 1, or if a number is not finite.
std::optional<Eigen::Isometry3d> rigid_motion_near(const Eigen::Matrix4d& matrix);

}  // namespace tanglebin
