#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/line_tree.hpp"
#include "tanglebin/model/axis/links/links.hpp"

namespace tanglebin {

/// The centre line of the tube (of this radius, m) that the fragments `members` form: their centre lines, the
/// gaps between them along the chosen links, and the junctions moved back.
LineTree assembled_line(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
                        const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
                        double radius);

}  // namespace tanglebin
