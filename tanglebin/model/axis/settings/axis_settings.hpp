#pragma once

#include <cstddef>

#include "tanglebin/model/axis/settings/link_weights.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Ramps: finds the points that a scanner has put between two surfaces.
struct RampSettings {
  double slope_min = 1.7;    ///< m of depth per m across the view, from each point of a ramp to the next
  double drop_min = 0.75;    ///< radii, of depth from end to end; a tube's flank has less
  double edge_min = 1.6;     ///< radii, the same for the edges that show what the scanner does
  double pixels_min = 5;     ///< pixels that a tube's radius must have
  int steps_max = 6;         ///< longer runs are steep surfaces
  double beside = 0.5;       ///< points beside a ramp that do not vote either, as a share of its length
  double blended_min = 0.1;  ///< share of blended edges from which on the scanner is one that makes ramps
};

/// Surface patches: a plane through the neighbours of each point.
struct PatchSettings {
  int neighbours = 40;          ///< desired number of points in a patch
  int neighbours_min = 5;       ///< a point with fewer neighbours has no patch
  double reach_min = 0.36;      ///< radii; the reach, within which points are neighbours, is at least this
  double reach_max = 0.85;      ///< radii; and at most this
  double breadth_min = 0.02;    ///< reaches²; minimum variance of the neighbours across their line
  double roughness_max = 3.0;   ///< medians; maximum variance of the neighbours about their plane
  bool at_every_point = false;  ///< even where points are so dense that fewer patches show as much
};

/// Vote: finds the axis point that a point's normal leads to.
struct VoteSettings {
  PatchSettings patch;
  double facing_min = 0.3;     ///< cosine of the angle between normal and view; where there are ramps
  double floor_margin = 0.5;   ///< radii; points nearer to the floor are not on a visible tube
  double bin_tolerance = 0.5;  ///< radii, by which an axis may be nearer to the bin than one radius
  int flat_min = 20;           ///< flat places, half a radius apart, that make a surface that does not vote
};

/// Fragment: finds thin clusters of votes and their centre lines.
struct FragmentSettings {
  double voxel = 0.32;         ///< radii; the axes of touching tubes are two radii apart
  double step = 0.4;           ///< radii, between the nodes of a centre line
  double branch_min = 1.6;     ///< radii; shorter branches of a centre line are dropped
  double end_length = 1.6;     ///< radii, length of the part that gives an end its direction
  double spot_max = 0.12;      ///< radii; votes with a smaller standard deviation count as a single spot
  double cap_min = 0.05;       ///< least eigenvalue of the mean of n nᵀ over the normals n of a cap
  double extent_min = 0.04;    ///< radii, from the last node of a centre line to its end
  double spread_max = 0.5;     ///< radii, from the votes to their centre line
  double share_min = 0.85;     ///< share of the votes that must be this near to it
  double weak_max = 0.1;       ///< medians; voxels with fewer votes connect nothing, where there are ramps
  double parallel_max = 0.96;  ///< length of the mean normal of a voxel; more are on a plane
  int points_min = 8;          ///< fragments with fewer points are dropped
  double speck_max = 0.05;     ///< and those with less than this share of the points on a radius of length
  double noisy_min = 0.04;     ///< radii, of the usual residual; with less, votes are not cut again
  double sure_min = 0.99;      ///< share of points probably right; with more, neither
};

/// Join: which links are possible, and their weights.
struct LinkSettings {
  double angle_max = 3.2;          ///< rad, α
  double length_tolerance = 0.03;  ///< how much longer than known a tube may be, as a fraction
  int ends_tolerance = 1;          ///< surplus ends that a tree may have, where noise made a branch
  double beyond_max = 3.2;         ///< radii, from a fragment's end to a hidden junction
  double seen_empty_max = 0.25;    ///< fraction of the gap between two ends that may be seen to be empty
  // Added to the log odds, because a fragment is more often part of a tube than a whole one.
  double chain_prior = 12.0;
  double tree_prior = 8.0;
  double junction_prior = 9.0;
  // Shape costs of a tree, in radii per unit of log odds: of its misfit() with the known tree, and of the
  // length it lacks.
  double misfit_unit = 0.9;
  double missing_unit = 4.0;
  // The cost of what a chain lacks though it should have been seen, in radii per unit of log odds.
  double unseen_unit = 1.0;
  double hidden_stretch = 2.0;      ///< a hidden way may be longer by this factor than it looks
  double strangeness_max = 2.0;     ///< TubeShapes::strangeness() of a chain that costs nothing
  double strangeness_weight = 3.0;  ///< log odds that a unit above it costs
  double bent_weight = 10.0;        ///< the same where the whole chains of the scan are bent
  double bent_empty = 4.0;   ///< log odds that a radius of a bent chain costs that was seen to be empty
  double bent_angles = 0.7;  ///< share of the weights of angles that counts where whole chains are bent
  LinkWeights weights = learned_weights;
};

/// Fit: lays straight pieces along a centre line and moves them by least squares.
struct TubeFitSettings {
  double tolerance = 0.08;       ///< radii; tolerance for simplifying a centre line before the fit
  double residual_max = 0.3;     ///< radii; points farther from the surface are ignored
  std::size_t points_max = 600;  ///< maximum number of points that a tube is fitted to
  int iterations = 4;            ///< Gauss-Newton steps
};

/// The parameters of the axis method. docs/algorithm.md explains how they were found.
struct AxisSettings {
  FilterSettings filter;
  RampSettings ramp;
  VoteSettings vote;
  FragmentSettings fragment;
  LinkSettings link;
  TubeFitSettings fit;
  LabelSettings label{.distance_max = 1};
};

}  // namespace tanglebin
