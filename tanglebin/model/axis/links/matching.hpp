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

/// Maximum-weight matching (Edmonds' algorithm) in a graph with this number of vertices. Only edges with
/// positive weights count. Returns ascending indices into `pairs`. Weights are rounded to 1e-6.
std::vector<std::size_t> heaviest_matching(std::size_t vertices, const std::vector<WeightedPair>& pairs);

}  // namespace tanglebin
