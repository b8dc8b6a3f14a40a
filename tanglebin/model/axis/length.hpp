#pragma once

#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// A kind of chains, with a length if it had none: the length, m, that most of the chains have of which the
/// sensor saw both ends, and else the longest of these. If there are none, half as much again as the longest
/// fragment.
TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings);

}  // namespace tanglebin
