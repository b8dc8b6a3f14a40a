#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/locate/patches.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room.
namespace tanglebin {

/// Poses (bin frame → camera frame) in which the bin may stand, to within some centimetres and degrees; the
/// likeliest first. Each has floor or rim on one of the planes. `closeness` (m) is how near a point must be
/// to a surface to count.
std::vector<Eigen::Isometry3d> possible_poses(const SensorView& view, const std::vector<FlatPatch>& patches,
                                              const std::vector<FlatPlane>& planes, const Bin& bin,
                                              double closeness);

}  // namespace tanglebin
