#pragma once

#include <Eigen/Core>

namespace tanglebin {

/// The points origin + t direction, t >= 0. Metres, world frame; the direction is a unit vector.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

}  // namespace tanglebin
