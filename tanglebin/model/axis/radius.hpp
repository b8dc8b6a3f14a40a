#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// The radius, m, of the tubes in a cloud (arguments as for model_tubes(); known.kinds are not looked
/// at). All tubes are taken to have one. Throws InputError for a cloud that shows too little of a tube.
double estimate_radius(const PointCloud& cloud, const KnownScene& known);

}  // namespace tanglebin
