#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// Looks how far the tube of each end may go on unseen, at most 40 radii: 0 where it was seen to end.
/// `radius` in m.
void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen);

}  // namespace tanglebin
