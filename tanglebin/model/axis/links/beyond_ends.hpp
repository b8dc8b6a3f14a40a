#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// Looks how far the tube of each end may go on unseen, straight ahead and along the walls and the floor that
/// it meets, at most 40 radii: 0 where it was seen to end. `radius` in m.
void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen);

/// How much a chain of this length lacks, m, beyond what may be hidden, of which there is `hidden` beyond
/// its ends (m). Below 0 if it may be whole, and if the kind's length is not known.
double unseen_length(double length, double hidden, const TubeKind& kind, const LinkSettings& settings);

}  // namespace tanglebin
