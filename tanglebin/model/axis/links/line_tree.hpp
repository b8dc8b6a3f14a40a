#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <vector>

#include "tanglebin/model/scene/segment_tree.hpp"

namespace tanglebin {

/// A centre line that may branch.
struct LineTree {
  std::vector<Eigen::Vector3d> nodes;  ///< m
  std::vector<std::array<std::size_t, 2>> edges;
};

/// The nodes that share an edge with a node: two except at ends and junctions.
using Neighbours = boost::container::small_vector<std::size_t, 3>;

/// The neighbours of each node.
std::vector<Neighbours> neighbours_in(const LineTree& line);

/// A line as paths between its named nodes, which are the ends and junctions.
class Paths {
public:
  explicit Paths(const LineTree& line);

  bool is_named(std::size_t node) const { return neighbours_[node].size() != 2; }

  /// Each path once, from the earlier of its named nodes to the later.
  const std::vector<std::vector<std::size_t>>& all() const { return paths_; }

private:
  void add_paths_from(std::size_t start);
  std::size_t after(const std::vector<std::size_t>& path) const;

  std::vector<Neighbours> neighbours_;
  std::vector<std::vector<std::size_t>> paths_;
};

/// A line, reduced to the lengths of its paths.
SegmentTree segments_of(const LineTree& line);

}  // namespace tanglebin
