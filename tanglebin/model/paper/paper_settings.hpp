#pragma once

#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Segment: regions of similar normals.
struct RegionSettings {
  int neighbours = 15;          ///< nearest points that a region grows to
  double angle_max = 0.25;      ///< rad, between the normals of neighbours in one region
  double curvature_max = 0.05;  ///< a point of more surface variation is an edge: no region grows on from it
  int points_min = 12;          ///< smaller regions are dropped
};

/// Fit: cylinders in a region, by RANSAC.
struct FitSettings {
  double distance_max =
      0.002;  ///< m, of an inlier: (1 − w) · distance to the surface + w · error of the normal
  double normal_weight = 0.02;     ///< w, the normal's error in radians
  double radius_tolerance = 0.15;  ///< of the known radius, either way
  double sample_distance = 0.05;   ///< m, between the two points that a trial cylinder is made of, at most
  int iterations_max = 150;        ///< trials for one cylinder
  int points_min = 12;             ///< inliers of a cylinder; also what must be left of a cluster to go on
  double gap_max = 0.02;           ///< m, along the axis; inliers beyond a longer gap are another cylinder's
  double claim_distance = 0.005;   ///< m; points this near to a cylinder's surface are not fitted again
  double length_min = 0.005;       ///< m, after trimming; shorter pieces have no direction to speak of
  double trim = 0.004;             ///< m, taken off each end, which reaches into the bend
};

/// Join: cylinders into tubes.
struct JoinSettings {
  double distance_max = 0.25;  ///< m, between two ends
  double angle_max = 2.5;  ///< rad, α: how far both cylinders together turn away from the way between them
  int hidden_radius = 5;   ///< pixels around the middle of the way that may hide it
  double length_tolerance = 0.05;  ///< of the known length, by which a tube may be too long
};

/// The parameters of the paper's method. The paper gives no values; docs/algorithm.md says how these were
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
