#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/paper/normals.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"

namespace tanglebin {

/// Clusters of neighbouring points with similar normals, by region growing (Rabbani et al. 2006, PCL's
/// implementation). Each is a list of indices into the cloud's arrays; some points are in no cluster.
std::vector<std::vector<std::size_t>> grow_regions(const OrientedCloud& cloud,
                                                   const RegionSettings& settings);

}  // namespace tanglebin
