#pragma once

#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// The deepest overlap of two tubes, m; 0 if none overlap. Throws InputError as validate(Tube) does.
double largest_tube_overlap(const std::vector<Tube>& tubes);

/// The deepest overlap of a tube with the floor or a wall, m; 0 if there is none. If a tube's centre line
/// enters the bin's material, its overlap counts as its radius. Throws InputError as validate(Tube) does.
double largest_bin_overlap(const std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
