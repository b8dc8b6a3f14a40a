#pragma once

#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// A kind of chains, with a length, m, in place of an unknown one: the length that most of the chains have of
/// which the sensor saw both ends. If most have none in common, the largest of theirs. If no chain is seen
/// from end to end, half as much again as the longest fragment. A length that was given, or the largest of a
/// range, stays, unless three such chains agree that it is too short. Trees stay as they are.
TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings);

}  // namespace tanglebin
