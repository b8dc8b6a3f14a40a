#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tanglebin {

/// A thin set of points and the tree that runs along it.
struct Skeleton {
  std::vector<std::size_t> points;     ///< indices of the set's points, ascending
  std::vector<Eigen::Vector3d> nodes;  ///< m; the first is at one end of the longest way through the set
  std::vector<std::size_t> parents;  ///< of each node an earlier one that it is connected to; 0 for the first
};

/// Connected thin sets of points (m; NaN are in none): points in voxels of size `voxel` that touch are of one
/// set. The nodes of its tree are about `step` apart along the set. Of the tree the longest path from the
/// first node is kept, and beside it only branches of at least `branch_min`.
std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points, double voxel, double step,
                                     double branch_min);

}  // namespace tanglebin
