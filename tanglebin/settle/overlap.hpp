#pragma once

#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How deep the two tubes that overlap most do so, m; 0 where none do.
double largest_tube_overlap(const std::vector<Tube>& tubes);

/// How deep the tube that is deepest in floor or wall is, m; 0 where none is. A tube whose centre line enters
/// the bin's material counts with its radius.
double largest_bin_overlap(const std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
