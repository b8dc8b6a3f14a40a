#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room.
namespace tanglebin {

/// A pixel at which the top of the rim ends at a step: beyond it, the camera saw something much lower, or
/// nothing.
struct RimEdge {
  Eigen::Vector3d point;  ///< m, camera frame: where the pixel's ray meets the plane of the rim
  Eigen::Vector3d step;   ///< m, in that plane: to there from the pixel before, towards where the rim ends
};

/// The edges near the rim of a bin in this pose (bin frame → camera frame). Points within `closeness` (m) of
/// the rim's plane are on it; the edges may be `reach` (m) away from where the bin has them.
std::vector<RimEdge> rim_edges(const SensorView& view, const Bin& bin, const Eigen::Isometry3d& pose,
                               double closeness, double reach);

}  // namespace tanglebin
