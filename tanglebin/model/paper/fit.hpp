#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "tanglebin/model/paper/normals.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"

namespace tanglebin {

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
