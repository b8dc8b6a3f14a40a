#include "tanglebin/model/axis/links/line_tree.hpp"

#include <utility>

namespace tanglebin {

std::vector<Neighbours> neighbours_in(const LineTree& line) {
  std::vector<Neighbours> neighbours(line.nodes.size());
  for (const auto& [first, second] : line.edges) {
    neighbours[first].push_back(second);
    neighbours[second].push_back(first);
  }
  return neighbours;
}

Paths::Paths(const LineTree& line) : neighbours_(neighbours_in(line)) {
  for (std::size_t start = 0; start < neighbours_.size(); ++start) {
    if (is_named(start)) add_paths_from(start);
  }
}

// Skips paths that end at an earlier node: these were added from their other end.
void Paths::add_paths_from(std::size_t start) {
  for (const std::size_t next : neighbours_[start]) {
    std::vector<std::size_t> path{start, next};
    while (!is_named(path.back())) path.push_back(after(path));
    if (path.back() > start) paths_.push_back(std::move(path));
  }
}

std::size_t Paths::after(const std::vector<std::size_t>& path) const {
  const Neighbours& around = neighbours_[path.back()];
  return around[0] == path[path.size() - 2] ? around[1] : around[0];
}

SegmentTree segments_of(const LineTree& line) {
  const Paths paths(line);
  SegmentTree segments;
  segments.reserve(paths.all().size());
  for (const std::vector<std::size_t>& path : paths.all()) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      length += (line.nodes[path[i + 1]] - line.nodes[path[i]]).norm();
    segments.push_back({static_cast<int>(path.front()), static_cast<int>(path.back()), length});
  }
  return segments;
}

}  // namespace tanglebin
