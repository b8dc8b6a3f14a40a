#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments/axis_votes.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"

namespace tanglebin {

/// An end of a fragment's centre line.
struct FragmentEnd {
  std::size_t node;          ///< index into Fragment::nodes
  Eigen::Vector3d position;  ///< m
  Eigen::Vector3d outward;   ///< unit, along the centre line
  double hidden = 0;         ///< m, how far its tube may go on unseen (look_beyond_ends())
};

/// A piece of a tube that is visible without a break.
struct Fragment {
  std::vector<std::size_t> points;     ///< indices, ascending
  std::vector<Eigen::Vector3d> nodes;  ///< m, nodes of its centre line, a tree
  std::vector<std::size_t> parents;    ///< for each node, the preceding one; 0 for the first
  std::vector<FragmentEnd> ends;       ///< two, and one more for each branch
  double length;                       ///< m, of the centre line
};

/// How far each node of a line is from the first one along it, m.
std::vector<double> ways_along(const std::vector<Eigen::Vector3d>& line);

/// How many points the fragments `members` have.
std::size_t number_of_points(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members);

/// The median number of points that a radius (m) of a fragment's length has; 0 if all fragments are short.
double points_on_a_radius(const std::vector<Fragment>& fragments, double radius);

/// Finds the fragments: thin clusters of votes. Centre lines branch only if `with_branches`. `radius` in m.
/// The votes are sorted into voxels, which are moved by `shift` voxels along each axis.
std::vector<Fragment> find_fragments(const AxisVotes& votes, double radius, bool with_branches,
                                     const FragmentSettings& settings, double shift = 0);

/// Keeps the fragments with the most points where there are more than so many. Returns how many it drops.
std::size_t keep_largest(std::vector<Fragment>& fragments, std::size_t most);

/// Cuts a fragment without branches at a node, whose points are left out. The second part is appended.
/// Returns false, and leaves the fragment whole, if a part has too few points to be a fragment.
bool cut_at(std::vector<Fragment>& fragments, std::size_t which, std::size_t node, const AxisVotes& votes,
            double radius, const FragmentSettings& settings);

/// Cuts fragments without branches that are much longer than tubes may be, `length_max` (m), so that neither
/// part is longer: two tubes whose ends touch. Only where next to no votes are; these points are left out.
/// Without such a place, the fragment stays as it is: the length may be wrong. Returns whether it cut any.
bool cut_too_long(std::vector<Fragment>& fragments, const AxisVotes& votes, double radius, double length_max,
                  const FragmentSettings& settings);

}  // namespace tanglebin
