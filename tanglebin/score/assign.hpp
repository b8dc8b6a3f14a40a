#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/score/confusion.hpp"

namespace tanglebin {

/// For each tube the segment that stands for it, none for a tube without one.
using Assignment = std::vector<std::optional<std::size_t>>;

/// The assignment of the most points (paper, Section 5): each segment to one tube at most, and only to one
/// that it overlaps. Of several that are best it takes one, the same for the same confusion. Exact;
/// O(v e log v) for v tubes and segments and e overlaps.
Assignment assign(const Confusion& confusion);

}  // namespace tanglebin
