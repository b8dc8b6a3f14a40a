#pragma once

#include <cstddef>
#include <vector>

namespace tanglebin {

/// The values at these indices, in their order.
template <typename Value>
std::vector<Value> picked(const std::vector<Value>& all, const std::vector<std::size_t>& indices) {
  std::vector<Value> result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) result.push_back(all[i]);
  return result;
}

}  // namespace tanglebin
