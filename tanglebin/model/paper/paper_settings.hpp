#pragma once

#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Segment: grows regions of similar normals.
struct RegionSettings {
  int neighbours = 15;          ///< nearest points that a region may grow to
  double angle_max = 0.25;      ///< rad, between the normals of neighbouring points in a region
  double curvature_max = 0.05;  ///< surface variation; regions do not grow beyond points above it (edges)
  int points_min = 12;          ///< smaller regions are dropped
};

/// Fit: finds cylinders in a region by RANSAC.
struct FitSettings {
  double distance_max =
      0.002;  ///< m, for inliers: (1 − w) · distance to the surface + w · error of the normal
  double normal_weight = 0.02;     ///< w, per radian of error of the normal
  double radius_tolerance = 0.15;  ///< relative to the known radius
  double sample_distance = 0.05;  ///< m, largest distance between the two points that define a trial cylinder
  int iterations_max = 150;       ///< trials for one cylinder
  int points_min = 12;  ///< inliers of a cylinder; also the points that must remain in a cluster to continue
  double gap_max = 0.02;  ///< m, along the axis; inliers beyond a longer gap belong to another cylinder
  double claim_distance = 0.005;  ///< m; points this near to a cylinder's surface are not fitted again
  double length_min = 0.005;      ///< m, after trimming; shorter pieces have no reliable direction
  double trim = 0.004;            ///< m, cut off each end, which reaches into the bend
};

/// Join: joins cylinders into tubes.
struct JoinSettings {
  double distance_max = 0.25;      ///< m, between two ends
  double angle_max = 2.5;          ///< rad, α: the angles of both cylinders with the gap between them
  int hidden_radius = 5;           ///< pixels around the middle of the gap in which an occluder counts
  double length_tolerance = 0.05;  ///< how much longer than known a tube may be, as a fraction
};

/// The parameters of the paper's method. The paper gives no values; docs/algorithm.md explains how these were
/// found and what each trades.
struct PaperSettings {
  FilterSettings filter;
  int normal_neighbours = 15;  ///< nearest points that a normal is estimated from
  RegionSettings segment;
  FitSettings fit;
  JoinSettings join;
  LabelSettings label;
};

}  // namespace tanglebin
