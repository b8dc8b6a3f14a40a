#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/axis/fragments/axis_votes.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"

namespace tanglebin {

/// The surface that a tube was fitted to, of what is seen of it beside the tube's ends. If that is next to
/// nothing, only the defaults.
struct TubeSurface {
  /// By how much its normals turn as one goes around the axis by one: 1 on a tube of this radius, more on a
  /// thinner one, less on a thicker one, 0 on a plane, such as the rim of a bin. None if too little of the
  /// circumference is seen to tell.
  std::optional<double> roundness{};
  /// The roundness that a tube of this radius would show. It is less than 1 where little of the circumference
  /// is seen, since normals are means over their neighbours.
  double roundness_of_a_tube = 1;
  /// m, the median of how much the distances of its points from the axis differ from their median: noise on
  /// a tube, also if its radius is not quite right; more on anything else, such as the edge of a box.
  double scatter = 0;
  /// How much of the variance of these distances goes with twice the angle around the axis: 0 on a cylinder
  /// of any radius, wherever its axis; more on an oval, a plane, or two planes that meet. 0 if their standard
  /// deviation is less than 0.01 radii.
  double ovality = 0;
  /// The cosine between the normals and the direction from the axis to the sensor, in the median.
  double facing = 1;
};

/// `members` are the fragments of the tube.
TubeSurface surface_of(const Tube& tube, const std::vector<Fragment>& fragments,
                       const std::vector<std::size_t>& members, const std::vector<Eigen::Vector3f>& points,
                       const AxisVotes& votes, const Camera& camera);

}  // namespace tanglebin
