#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/filter.hpp"

namespace tanglebin {

struct SegmentSettings {
  int neighbours = 15;          ///< nearest points that a region grows to
  double angle_max = 0.25;      ///< rad, between the normals of neighbours in one region
  double curvature_max = 0.05;  ///< a point of more surface variation is an edge: no region grows on from it
  int points_min = 12;          ///< smaller regions are dropped
};

/// Clusters of neighbouring points with similar normals: region growing (Rabbani et al. 2006, as PCL has it).
/// Each is a list of indices into the cloud's arrays; some points are in none.
std::vector<std::vector<std::size_t>> grow_regions(const OrientedCloud& cloud,
                                                   const SegmentSettings& settings);

}  // namespace tanglebin
