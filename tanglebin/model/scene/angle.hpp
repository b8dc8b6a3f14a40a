#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace tanglebin {

/// The angle between two directions of any length: rad, in [0, π]. Accurate near 0 and π too.
inline double angle_between(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

}  // namespace tanglebin
