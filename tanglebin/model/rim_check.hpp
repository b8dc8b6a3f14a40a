#pragma once

#include <optional>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/model/scene/finding.hpp"

// Internal to the room.
namespace tanglebin {

/// A warning if the rim of a bin is seen beside its place, turned, leaning, or as that of a bin of another
/// size. What is within 3 mm and the support's margin is right. The cloud is in m, world frame. None if too
/// little of the rim is seen; a bin that stands too high is not found out.
std::optional<Finding> doubt_of_rim_place(const PointCloud& cloud, const Support& support);

}  // namespace tanglebin
