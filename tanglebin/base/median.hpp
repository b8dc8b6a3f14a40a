#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tanglebin {

/// The median of at least one value; of an even number, the greater of the two in the middle.
template <typename Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace tanglebin
