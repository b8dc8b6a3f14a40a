#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tanglebin/model/axis/fragments.hpp"

namespace tanglebin {

/// The space that fragments fill, where no other tube can be.
class Obstacles {
public:
  Obstacles(const std::vector<Fragment>& fragments, double radius);

  /// How deep a point (m, world frame) of a tube's axis lies inside fragments other than `first` and
  /// `second`: 1 on the centre line of one, 0 at a diameter or more from all.
  double overlap(const Eigen::Vector3d& axis, std::size_t first, std::size_t second) const;

private:
  struct Node {
    Eigen::Vector3d position;
    std::size_t fragment;
  };

  double diameter_;
  // For each cell, a diameter wide: the nodes in it and in the cells around it.
  std::unordered_map<std::uint64_t, std::vector<Node>> around_;
};

}  // namespace tanglebin
