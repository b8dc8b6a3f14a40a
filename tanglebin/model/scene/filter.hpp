#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Indices, ascending, of the points around the known bin that are not the bin itself. The crop box follows
/// the floor and walls. Nothing is cropped above the rim, because tubes stick out over it. Points without a
/// finite position are dropped.
std::vector<std::size_t> crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings);

/// Draws ratio · size of the indices (rounded) at random without replacement, and keeps their order.
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed);

}  // namespace tanglebin
