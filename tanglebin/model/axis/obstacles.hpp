#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tanglebin/model/axis/fragments.hpp"

namespace tanglebin {

/// Where fragments of tubes are, so that no other tube is there.
class Obstacles {
public:
  Obstacles(const std::vector<Fragment>& fragments, double radius);

  /// How deep the axis of a tube (m, world frame) is in fragments other than two: 1 on the centre line of
  /// one, 0 where it is a diameter away from all of them.
  double overlap(const Eigen::Vector3d& axis, std::size_t first, std::size_t second) const;

private:
  struct Node {
    Eigen::Vector3d position;
    std::size_t fragment;
  };

  double diameter_;
  std::unordered_map<std::uint64_t, std::vector<Node>> around_;  // cells, a diameter wide, and next to them
};

}  // namespace tanglebin
