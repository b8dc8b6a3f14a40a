#include "tanglebin/score/centre_line.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tanglebin {

CentreLine::CentreLine(const Tube& tube)
    : radius_(tube.radius),
      capsules_(tanglebin::capsules(tube)),
      edges_(tube.edges),
      parents_(tube.nodes.size()),
      levels_(tube.nodes.size()),
      depths_(tube.nodes.size()) {
  for (const Capsule& capsule : capsules_) box_.extend(capsule.a).extend(capsule.b);
  hang_up();
}

// Breadth-first from node 0.
void CentreLine::hang_up() {
  std::vector<std::vector<std::size_t>> edges_at(parents_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    edges_at[edges_[i].from].push_back(i);
    edges_at[edges_[i].to].push_back(i);
  }
  std::vector<std::size_t> reached{0};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::size_t node = reached[i];
    for (const std::size_t edge : edges_at[node]) {
      const std::size_t next = edges_[edge].from == node ? edges_[edge].to : edges_[edge].from;
      if (next == parents_[node]) continue;
      parents_[next] = node;
      levels_[next] = levels_[node] + 1;
      depths_[next] = depths_[node] + (capsules_[edge].b - capsules_[edge].a).norm();
      reached.push_back(next);
    }
  }
}

CentreLine::Nearest CentreLine::nearest(const Eigen::Vector3d& point) const {
  std::size_t best = 0;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < capsules_.size(); ++i) {
    const double candidate = axis_distance(capsules_[i], point);
    if (candidate >= distance) continue;
    best = i;
    distance = candidate;
  }
  const auto& [from, to] = std::pair(edges_[best].from, edges_[best].to);
  const double t = nearest_on_axis(capsules_[best], point);
  const double depth = depths_[from] + t * (depths_[to] - depths_[from]);
  return {{levels_[from] > levels_[to] ? from : to, depth}, distance};
}

double CentreLine::way(const Place& a, const Place& b) const {
  std::size_t above_a = a.node;
  std::size_t above_b = b.node;
  while (above_a != above_b) {
    std::size_t& lower = levels_[above_a] > levels_[above_b] ? above_a : above_b;
    lower = parents_[lower];
  }
  // The path goes up to where both paths to node 0 meet, unless one place is above the other.
  const double top = std::min({a.depth, b.depth, depths_[above_a]});
  return a.depth + b.depth - 2 * top;
}

}  // namespace tanglebin
