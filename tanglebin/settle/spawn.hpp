#pragma once

#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Places tubes above the bin, all at once and clear of each other, where they fall into it. Each is lowered
/// to a slope of 45° where it is steeper, turned about the vertical until its outline fits the bin's opening,
/// put at a random place over it, and raised until it is clear of the rim and of the tubes before it.
void spawn(Rng& rng, std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
