#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "tanglebin/model/paper/normals.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"

namespace tanglebin {

/// A straight piece of a tube.
struct Cylinder {
  std::array<Eigen::Vector3d, 2> ends;  ///< m, on the axis
  std::vector<std::size_t> points;      ///< its inliers: indices into the cloud's arrays, ascending
  double trimmed = 0;                   ///< m, cut off each end
};

/// Finds cylinders of about the known radius (m) in one cluster of the cloud: RANSAC with normals, repeated
/// on the remaining points until it finds no more.
std::vector<Cylinder> fit_cylinders(const OrientedCloud& cloud, const std::vector<std::size_t>& cluster,
                                    double radius, const FitSettings& settings);

}  // namespace tanglebin
