#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/surface_patches.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// What the points of a cloud say of the axes of the tubes that they are on: arrays of the points' size, NaN
/// where a point has nothing to say.
struct AxisVotes {
  std::vector<Eigen::Vector3f> votes;    ///< m, a point of the axis
  std::vector<Eigen::Vector3f> normals;  ///< unit, of the surface, towards the sensor
};

/// The surface's normal at a point of a tube of known radius (m) leads to the tube's axis. Normals are those
/// of planes through the neighbours in the camera's image; where two surfaces meet there is none. An axis
/// that would lie in the bin's floor or walls, or too near to them, is not voted for.
AxisVotes vote_for_axes(const std::vector<Eigen::Vector3f>& points, const Bin& bin, const Camera& camera,
                        double radius, const VoteSettings& settings);

}  // namespace tanglebin
