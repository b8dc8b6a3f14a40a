#include "tanglebin/score/assign.hpp"

// Compiled as C++17, because LEMON 1.3.1 uses members of std::allocator that C++20 removed. Uses LEMON's
// templates only, not its library.
#define LEMON_ONLY_TEMPLATES
#include <lemon/matching.h>
#include <lemon/smart_graph.h>

namespace tanglebin {
namespace {

using Graph = lemon::SmartGraph;

std::vector<Graph::Node> add_nodes(Graph& graph, std::size_t count) {
  std::vector<Graph::Node> nodes;
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(graph.addNode());
  return nodes;
}

}  // namespace

Assignment assign(const Confusion& confusion) {
  Graph graph;
  const auto tubes = add_nodes(graph, confusion.tubes.size());
  const auto segments = add_nodes(graph, confusion.segments.size());
  Graph::EdgeMap<std::int64_t> points(graph);
  for (const Overlap& overlap : confusion.overlaps) {
    points[graph.addEdge(tubes[overlap.tube], segments[overlap.segment])] = overlap.points;
  }

  lemon::MaxWeightedMatching<Graph, Graph::EdgeMap<std::int64_t>> matching(graph, points);
  matching.run();

  Assignment assignment(confusion.tubes.size());
  for (const Overlap& overlap : confusion.overlaps) {
    if (matching.mate(tubes[overlap.tube]) == segments[overlap.segment]) {
      assignment[overlap.tube] = overlap.segment;
    }
  }
  return assignment;
}

}  // namespace tanglebin
