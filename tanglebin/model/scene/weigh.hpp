#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// Adds to the evidence of each tube what follows from its centre line and the points with its label: all but
/// its kind and joins, which the methods give. Looks at some 300 points of each tube. Cloud (m), scene and
/// model are in one frame.
void weigh(Model& model, const PointCloud& cloud, const KnownScene& known);

}  // namespace tanglebin
