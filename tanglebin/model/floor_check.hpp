#pragma once

#include <optional>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/finding.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

// Internal to the room.
namespace tanglebin {

/// A warning if the floor of the support, a bin or a plane, is seen higher or lower than it is known to be.
/// Floor is what is flat, level and broader than a tube; what is left of tubes is not. All in m, world frame;
/// of the model, the labels.
std::optional<Finding> doubt_of_floor_height(const PointCloud& cloud, const KnownScene& known,
                                             const Model& model);

}  // namespace tanglebin
