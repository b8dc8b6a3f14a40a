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

/// How the surface that a tube was fitted to curves around its axis: by how much its normals turn as one goes
/// around the axis by one. 1 on a tube of this radius, more on a thinner one, less on a thicker one, 0 on a
/// plane, such as the rim of a bin. None if too little of the circumference is seen to tell.
std::optional<double> roundness(const Tube& tube, const std::vector<Fragment>& fragments,
                                const std::vector<std::size_t>& members,
                                const std::vector<Eigen::Vector3f>& points, const AxisVotes& votes,
                                const Camera& camera);

}  // namespace tanglebin
