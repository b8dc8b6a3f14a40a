#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/model/axis_votes.hpp"

namespace tanglebin {

struct FragmentSettings {
  double voxel = 0.32;       ///< radii; axes of tubes that touch are two radii apart
  double step = 0.4;         ///< radii, between the nodes of a centre line
  double branch_min = 1.6;   ///< radii; a shorter branch of a centre line is no branch
  double end_length = 1.6;   ///< radii, of the part of a fragment that gives the direction of its end
  double spot_max = 0.12;    ///< radii, of the standard deviation of votes that are all in one place
  double cap_min = 0.05;     ///< of the mean of n nᵀ over the normals n of a cap, the least eigenvalue
  double extent_min = 0.04;  ///< radii, from the last node of a centre line to its end
  double spread_max = 0.5;   ///< radii; votes are this near to their centre line, half of them at least
  int points_min = 8;        ///< a fragment of fewer points is none
};

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
