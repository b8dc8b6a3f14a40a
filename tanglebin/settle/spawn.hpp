#pragma once

#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Places all tubes above the bin, clear of each other, so that they fall into it. A tube steeper than 45° is
/// tilted down to that. Each tube is turned about the vertical until its outline fits the bin's opening, put
/// at a random position above it, and raised until it is clear of the rim and of the tubes before it. Throws
/// InputError as validate(Tube) does.
void spawn(Rng& rng, std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
