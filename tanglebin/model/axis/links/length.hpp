#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// A kind of chains, with a length, m, in place of an unknown one. It is the length that many chains share,
/// when their pieces are linked: at least three that are seen from end to end in one piece, or three tenths
/// of the length of all. If chains have no length in common, it is the longest that is seen from end to end,
/// or else twice the longest fragment. A length that was given, or the largest of a range, stays, unless at
/// least three chains agree that it is too short. Trees stay as they are.
TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings);

}  // namespace tanglebin
