#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// Fills in model.counts, from the cloud (m, in the support's frame) and the labels. The known camera cannot
/// have seen what is behind it or outside of its image: such points were not looked at, and become null.
void count_points(Model& model, const PointCloud& cloud, const KnownScene& known,
                  const FilterSettings& settings);

}  // namespace tanglebin
