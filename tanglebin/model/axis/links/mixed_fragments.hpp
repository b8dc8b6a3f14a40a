#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"

namespace tanglebin {

/// Cuts fragments without branches that look like no part of the known tubes, where the two parts do: two
/// tubes whose votes hang together. Only if the known tubes are bent: a part of a straight one fits anywhere.
/// `radius` in m. Returns whether it cut any.
bool cut_mixed(std::vector<Fragment>& fragments, const AxisVotes& votes, double radius,
               const TubeShapes& shapes, const FragmentSettings& settings);

}  // namespace tanglebin
