#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// Estimates the one radius, m, of all tubes in a cloud. Arguments as for model_tubes(); known.kinds is
/// ignored. Throws InputError if the cloud shows too little of a tube.
double estimate_radius(const PointCloud& cloud, const KnownScene& known);

}  // namespace tanglebin
