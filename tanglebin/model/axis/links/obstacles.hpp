#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"

namespace tanglebin {

/// A part of the space that a tube fills.
struct Ball {
  Eigen::Vector3d centre;  ///< m, world frame
  double radius;           ///< m
};

/// The space that fragments fill, where no other tube can be.
class Obstacles {
public:
  /// `radius` is that of the fragments' tubes, m; `others` is what tubes of other kinds fill.
  Obstacles(const std::vector<Fragment>& fragments, double radius, const std::vector<Ball>& others);

  /// How deep a tube of this radius whose axis passes through a point (m, world frame) would lie inside
  /// fragments other than `first` and `second`: 1 on the centre line of one, 0 where it touches none.
  double overlap(const Eigen::Vector3d& axis, std::size_t first, std::size_t second) const;

private:
  struct Node {
    Eigen::Vector3d position;
    double reach;  // m, from this node to an axis, where the two tubes touch
    std::size_t fragment;
  };
  void add(const Node& node);

  double cell_;  // m, the largest reach
  // For each cell: the nodes in it and in the cells around it.
  std::unordered_map<std::uint64_t, std::vector<Node>> around_;
};

}  // namespace tanglebin
