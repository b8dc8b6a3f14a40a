#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/score/confusion.hpp"

namespace tanglebin {

/// For each tube, its segment; none if it has no segment.
using Assignment = std::vector<std::optional<std::size_t>>;

/// The assignment with the most points (paper, Section 5). Each segment goes to at most one tube, and only to
/// one that it overlaps. If several assignments are best, the choice depends only on the confusion. Exact;
/// O(v e log v) for v tubes and segments and e overlaps.
Assignment assign(const Confusion& confusion);

}  // namespace tanglebin
