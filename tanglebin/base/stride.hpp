#pragma once

#include <cstddef>

namespace tanglebin {

/// A stride that takes at most `wanted` (at least 1) of so many items, evenly. It is 1 or a prime: so a
/// sample of what repeats, as the rows of an image do, shows all of it in its proportion.
std::size_t sampling_stride(std::size_t items, std::size_t wanted);

}  // namespace tanglebin
