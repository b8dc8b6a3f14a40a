#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/axis_votes.hpp"

namespace tanglebin {

/// Where a fragment's centre line ends.
struct FragmentEnd {
  std::size_t node;          ///< index into Fragment::nodes
  Eigen::Vector3d position;  ///< m
  Eigen::Vector3d outward;   ///< unit, along the centre line
};

/// A piece of a tube that is seen without a break.
struct Fragment {
  std::vector<std::size_t> points;     ///< its points, ascending indices
  std::vector<Eigen::Vector3d> nodes;  ///< m, of its centre line, a tree
  std::vector<std::size_t> parents;    ///< of each node the one before; 0 for the first
  std::vector<FragmentEnd> ends;       ///< two, and one more for each branch
  double length;                       ///< m, of the centre line
};

/// Thin clusters of votes. Fragments branch only where tubes do (`with_branches`).
std::vector<Fragment> find_fragments(const AxisVotes& votes, double radius, bool with_branches,
                                     const FragmentSettings& settings);

}  // namespace tanglebin
