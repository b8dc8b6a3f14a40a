#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/model.hpp"
#include "tanglebin/model/surface_patches.hpp"

namespace tanglebin {

struct VoteSettings {
  PatchSettings patch;
  double floor_margin = 0.5;  ///< radii; a point nearer to the floor is not on a tube that is seen from above
  double bin_tolerance = 0.3;  ///< radii, by which an axis may be nearer to the bin than a radius
};

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
