#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// The points around the known bin that are not the bin itself: a crop box for floor and walls, and nothing
/// is cut above the rim, since tubes stick out over it. Points without a finite position are left out. Gives
/// indices, ascending.
std::vector<std::size_t> crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings);

/// Draws a share of the indices at random, without putting back, in their order: ratio · size of them,
/// rounded.
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed);

}  // namespace tanglebin
