#include "tanglebin/model/axis/links/matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

// Compiled as C++17, because LEMON 1.3.1 uses members of std::allocator that C++20 removed. Uses LEMON's
// templates only, not its library.
#define LEMON_ONLY_TEMPLATES
#include <lemon/matching.h>
#include <lemon/smart_graph.h>

namespace tanglebin {

std::vector<std::size_t> heaviest_matching(std::size_t vertices, const std::vector<WeightedPair>& pairs) {
  using Graph = lemon::SmartGraph;
  Graph graph;
  graph.reserveNode(static_cast<int>(vertices));
  std::vector<Graph::Node> nodes;
  nodes.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) nodes.push_back(graph.addNode());
  // Integers, so that the algorithm's comparisons are exact.
  constexpr double unit = 1e6;
  Graph::EdgeMap<std::int64_t> weights(graph);
  Graph::EdgeMap<std::size_t> pair_of(graph);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int64_t weight = std::llround(pairs[i].weight * unit);
    if (weight <= 0) continue;
    const Graph::Edge edge = graph.addEdge(nodes[pairs[i].first], nodes[pairs[i].second]);
    weights[edge] = weight;
    pair_of[edge] = i;
  }
  lemon::MaxWeightedMatching<Graph, Graph::EdgeMap<std::int64_t>> matching(graph, weights);
  matching.run();
  std::vector<std::size_t> taken;
  for (Graph::EdgeIt edge(graph); edge != lemon::INVALID; ++edge) {
    if (matching.matching(edge)) taken.push_back(pair_of[edge]);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

}  // namespace tanglebin
