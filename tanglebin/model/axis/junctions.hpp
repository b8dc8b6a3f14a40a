#pragma once

#include "tanglebin/model/axis/line_tree.hpp"

namespace tanglebin {

/// Two branches that leave a junction at a sharp angle are seen as one for a while, and part too late. This
/// moves a junction of three branches back along the third, to where the other two would meet if they went
/// straight on, and draws them straight from there. Tubes have this radius, m.
LineTree with_junctions_drawn_back(LineTree line, double radius);

}  // namespace tanglebin
