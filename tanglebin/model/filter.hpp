#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/settle/bin.hpp"

namespace tanglebin {

struct FilterSettings {
  double margin = 0.0005;      ///< m, a point nearer than this to the bin's walls or floor is the bin's
  double overhang = 0.3;       ///< m, how far beyond the bin, to the sides and upwards, points are kept
  int normal_neighbours = 15;  ///< nearest points that a normal is estimated from
};

/// Points with their normals; arrays of equal length.
struct OrientedCloud {
  std::vector<std::size_t> indices;      ///< in the cloud that they come from, ascending
  std::vector<Eigen::Vector3f> points;   ///< m
  std::vector<Eigen::Vector3f> normals;  ///< unit, towards the sensor
  std::vector<float> curvatures;         ///< surface variation: 0 on a plane
};

/// The points around the known bin that are not the bin itself: a crop box for floor and walls, and nothing
/// is cut above the rim, since tubes stick out over it. Points without a finite position are left out. Gives
/// indices, ascending.
std::vector<std::size_t> crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings);

/// Draws a share of the indices at random, without putting back, in their order: ratio · size of them,
/// rounded.
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed);

/// These points with normals from their nearest neighbours among them, turned towards `sensor` (m). A cloud
/// of fewer than three points has no normals: the result is empty.
OrientedCloud with_normals(const PointCloud& cloud, const std::vector<std::size_t>& indices,
                           const Eigen::Vector3d& sensor, const FilterSettings& settings);

}  // namespace tanglebin
