#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// A kind of chains, with a length, m, in place of an unknown one. Each length from that of the third longest
/// fragment on is tried as though it had been told, and the one with the most evidence counts: the log odds
/// of the links that are chosen, without their prior, and the chains that come out as long as that. If at
/// least three do, it is the length of all, else the largest is the one with the most evidence with the
/// prior. A length that was given, or the largest of a range, stays, unless fragments are longer, at least
/// three chains agree that it is too short, and there is less evidence for it. Trees stay as they are.
TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings);

}  // namespace tanglebin
