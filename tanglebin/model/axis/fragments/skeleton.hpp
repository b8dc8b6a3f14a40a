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
  bool is_face = false;                ///< of a tube's flat end, from its middle one radius inwards
};

/// What a set of votes must look like to be of one tube.
struct CutSettings {
  double branch_min;       ///< m, as for find_skeletons()
  double spread_max;       ///< m; votes are this near to the skeleton
  double share_min;        ///< share of the votes that must be
  double weak_max;         ///< median numbers of votes; voxels with fewer are left out from the start
  double parallel_max;     ///< length of the mean of the normals in a voxel; more is a plane
  bool may_branch;         ///< whether the skeleton may have branches
  double shift = 0;        ///< voxels, by which the grid of voxels is moved along each axis
  double face_radius = 0;  ///< m, of the tubes' flat ends; 0 if these are not looked for
};

/// Finds connected thin sets of points (m; NaN points are in none). Points in touching voxels of size `voxel`
/// belong to one set. The nodes of its tree are about `step` apart along the set. The tree keeps the longest
/// path from the first node, and branches of at least `branch_min`.
std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points, double voxel, double step,
                                     double branch_min);

/// The same, but a set that does not look like one tube is cut: at the voxels with the fewest votes, then
/// where its tree forks. Pieces that cannot be cut any more and still do not look like a tube are left out,
/// and so are the voxels at the cuts. A tube that is seen end-on may show nothing but its flat end. The votes
/// of such a face are a disc.
std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points,
                                     const std::vector<Eigen::Vector3f>& normals, double voxel, double step,
                                     const CutSettings& settings);

}  // namespace tanglebin
