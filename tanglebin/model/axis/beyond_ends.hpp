#pragma once

#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// Looks how far the tube of each end may go on unseen: straight ahead, and where the bin is in the way, from
/// there along its wall; at most 40 radii each. 0 where it was seen to end. `radius` in m.
void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen);

/// How far the tube of this end may go on unseen in all, m.
inline double unseen_way(const FragmentEnd& end) {
  return end.hidden + end.along_wall;
}

/// How much a chain of this length lacks, m, beyond what may be hidden, of which there is `hidden` beyond its
/// ends (m), as look_beyond_ends() says. Below 0 if it may be whole, and if the kind's length is not known.
double unseen_length(double length, double hidden, const TubeKind& kind, const LinkSettings& settings);

}  // namespace tanglebin
