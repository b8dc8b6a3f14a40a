#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/scene/evidence.hpp"

namespace tanglebin {

/// The chosen links as joins, one for each, in their order. A join's margin is what the sum of the links'
/// weights would lose, at the least, if its ends were free or linked otherwise, where no tube may become
/// longer than `length_max` (m).
std::vector<TubeJoin> joins_of(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                               const std::vector<std::size_t>& chosen, double length_max);

}  // namespace tanglebin
