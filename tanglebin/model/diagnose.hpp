#pragma once

#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// What does not fit between a cloud (m, world frame), what is known of its scene and the tubes that were
/// found: errors, then warnings. The model needs its counts and evidence; `ratio` is that of the
/// downsampling. docs/formats.md lists all findings.
std::vector<Finding> diagnose(const PointCloud& cloud, const KnownScene& known, const Model& model,
                              double ratio);

}  // namespace tanglebin
