#pragma once

#include "tanglebin/model/axis/links/line_tree.hpp"

namespace tanglebin {

/// Two branches that leave a junction at a sharp angle look like one at first, so the junction is seen too
/// far out. Moves each junction of three branches back along the third, to where the other two would meet if
/// they went straight on, and redraws them as straight lines from there. `radius` is that of the tubes, m.
LineTree with_junctions_drawn_back(LineTree line, double radius);

}  // namespace tanglebin
