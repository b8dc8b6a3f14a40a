#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tanglebin {

/// A thin set of points, with the tree that runs along it.
struct Skeleton {
  std::vector<std::size_t> points;     ///< indices of the set's points, ascending
  std::vector<Eigen::Vector3d> nodes;  ///< m; the first is at one end of the longest path through the set
  std::vector<std::size_t> parents;    ///< for each node, a connected earlier one; 0 for the first
};

/// Finds connected thin sets of points (m; NaN points are in none). Points in touching voxels of size `voxel`
/// belong to one set. The nodes of its tree are about `step` apart along the set. The tree keeps the longest
/// path from the first node, and branches of at least `branch_min`.
std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points, double voxel, double step,
                                     double branch_min);

}  // namespace tanglebin
