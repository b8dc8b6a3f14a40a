#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/axis/links.hpp"

namespace tanglebin {

/// The tube of some fragments (their indices) and of those of the chosen links that are between them:
/// straight pieces, as few as follow the fragments' centre lines, then moved by least squares so that the
/// surface of this radius (m) passes through the fragments' points. Ends and junctions are nodes 1, 2, …;
/// mass 0.
Tube fit_tube(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
              const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
              const std::vector<Eigen::Vector3f>& points, double radius, const TubeFitSettings& settings);

}  // namespace tanglebin
