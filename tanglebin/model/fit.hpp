#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "tanglebin/model/filter.hpp"

namespace tanglebin {

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

/// A piece of a tube that is straight.
struct Cylinder {
  std::array<Eigen::Vector3d, 2> ends;  ///< m, on the axis
  std::vector<std::size_t> points;      ///< its inliers: indices into the cloud's arrays, ascending
};

/// Cylinders of about the known radius (m) in one cluster of the cloud: RANSAC with normals, repeated on what
/// the last cylinder left until none is found.
std::vector<Cylinder> fit_cylinders(const OrientedCloud& cloud, const std::vector<std::size_t>& cluster,
                                    double radius, const FitSettings& settings);

}  // namespace tanglebin
