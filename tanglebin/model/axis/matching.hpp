#pragma once

#include <cstddef>
#include <vector>

namespace tanglebin {

/// An edge of a graph.
struct WeightedPair {
  std::size_t first;
  std::size_t second;
  double weight;
};

/// The edges of a graph of `vertices` vertices that share none of them and whose weights, of which only
/// positive ones count, have the greatest sum: indices into `pairs`, ascending. Exact to the millionth
/// (Edmonds' algorithm).
std::vector<std::size_t> heaviest_matching(std::size_t vertices, const std::vector<WeightedPair>& pairs);

}  // namespace tanglebin
