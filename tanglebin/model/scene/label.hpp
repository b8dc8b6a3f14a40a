#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// For each point (an index into the cloud): the id of the tube with the nearest cylinder or joint, or
/// null_label if none is near enough.
std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings);

/// A label for each point of the cloud: bin_label if the crop removed the point, null_label if it has no
/// position. Any other point gets its label in `claimed` or, if that is null, the label of the nearest
/// surface. `cropped` lists the points that the crop kept.
std::vector<std::int32_t> label_points(const PointCloud& cloud, const std::vector<std::size_t>& cropped,
                                       const std::vector<std::int32_t>& claimed,
                                       const std::vector<Tube>& tubes, const LabelSettings& settings);

}  // namespace tanglebin
