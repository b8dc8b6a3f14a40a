#pragma once

#include <cstddef>

#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Surface patches: the plane through the neighbours of each point.
struct PatchSettings {
  int neighbours = 40;         ///< points that a patch has, about
  int neighbours_min = 5;      ///< a point with fewer has no patch
  double reach_min = 0.36;     ///< radii; neighbours are nearer than the reach, which is chosen between
  double reach_max = 0.85;     ///< radii; these two
  double breadth_min = 0.02;   ///< reaches², least variance of the neighbours across their line
  double roughness_max = 3.0;  ///< medians, most variance of the neighbours about their plane
};

/// Vote: the point of a tube's axis that a point and its patch's normal lead to.
struct VoteSettings {
  PatchSettings patch;
  double floor_margin = 0.5;  ///< radii; a point nearer to the floor is not on a tube that is seen from above
  double bin_tolerance = 0.3;  ///< radii, by which an axis may be nearer to the bin than a radius
};

/// Fragment: thin clusters of votes and their centre lines.
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

/// Join: which links there may be, and what they weigh.
struct LinkSettings {
  double angle_max = 3.2;          ///< rad, α
  double length_tolerance = 0.03;  ///< of the known length, by which a tube may be too long
  int ends_tolerance = 1;          ///< ends that a tree may have too many: where noise made a branch
  double beyond_max = 3.2;         ///< radii, from the end of a fragment to a junction that is hidden
  double seen_empty_max = 0.25;    ///< share of the way between two ends that may be seen to be empty
  // Added to the log odds, since a fragment is more often a part of a tube than one by itself.
  double chain_prior = 16.0;
  double tree_prior = 8.0;
  double junction_prior = 9.0;
  // Radii, of a tree that links make, that take one from the logarithm of its odds: of misfit() with the
  // known tree, and of what it lacks of that.
  double misfit_unit = 0.9;
  double missing_unit = 4.0;
};

/// Fit: straight pieces along a centre line, moved by least squares.
struct TubeFitSettings {
  double tolerance = 0.08;    ///< radii, by which a centre line may miss the fragments' nodes before the fit
  double residual_max = 0.3;  ///< radii; a point farther from the surface does not count
  std::size_t points_max = 600;  ///< points that a tube is fitted to
  int iterations = 4;            ///< Gauss-Newton steps
};

/// The parameters of the axis method; docs/algorithm.md says how they were found.
struct AxisSettings {
  FilterSettings filter;
  VoteSettings vote;
  FragmentSettings fragment;
  LinkSettings link;
  TubeFitSettings fit;
  LabelSettings label;
};

}  // namespace tanglebin
