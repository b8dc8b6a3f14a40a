#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Points with normals; all arrays have the same length.
struct OrientedCloud {
  std::vector<std::size_t> indices;      ///< in the original cloud, ascending
  std::vector<Eigen::Vector3f> points;   ///< m
  std::vector<Eigen::Vector3f> normals;  ///< unit, towards the sensor
  std::vector<float> curvatures;         ///< surface variation: 0 on a plane
};

/// The points at `indices`, each with a normal from its `neighbours` nearest points among them, turned
/// towards `sensor` (m). Fewer than three points have no normals; the result is then empty.
OrientedCloud with_normals(const PointCloud& cloud, const std::vector<std::size_t>& indices,
                           const Eigen::Vector3d& sensor, int neighbours);

}  // namespace tanglebin
