#pragma once

#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

/// Places tubes above the bin, all at once and clear of each other, where they fall into it. Each is turned
/// about the vertical until its outline fits the bin's opening, put at a random place over it, and then as
/// low as the rim and the tubes below it allow. (Shape and tilt stay as drawn.)
void spawn(Rng& rng, std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
