#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Points with their normals; arrays of equal length.
struct OrientedCloud {
  std::vector<std::size_t> indices;      ///< in the cloud that they come from, ascending
  std::vector<Eigen::Vector3f> points;   ///< m
  std::vector<Eigen::Vector3f> normals;  ///< unit, towards the sensor
  std::vector<float> curvatures;         ///< surface variation: 0 on a plane
};

/// These points with normals from their `neighbours` nearest among them, turned towards `sensor` (m). A cloud
/// of fewer than three points has no normals: the result is empty.
OrientedCloud with_normals(const PointCloud& cloud, const std::vector<std::size_t>& indices,
                           const Eigen::Vector3d& sensor, int neighbours);

}  // namespace tanglebin
