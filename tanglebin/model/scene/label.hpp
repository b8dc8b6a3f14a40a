#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// For each of the points (indices into the cloud) the id of the tube whose cylinder or joint is nearest, or
/// null_label where none is near enough.
std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings);

/// A label for each point of the cloud: the bin's for what the crop took away (`cropped` is what it left),
/// null for what has no position, and of the others the one that it has in `claimed` (null where it has
/// none), or else that of the nearest surface.
std::vector<std::int32_t> label_points(const PointCloud& cloud, const std::vector<std::size_t>& cropped,
                                       const std::vector<std::int32_t>& claimed,
                                       const std::vector<Tube>& tubes, const LabelSettings& settings);

}  // namespace tanglebin
