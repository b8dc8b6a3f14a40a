#pragma once

#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

// Whether a cloud looks as the known camera sees the known support. All in m, world frame; of the model, the
// points that were kept, and the counts.
namespace tanglebin {

/// Warnings that the cloud seems to be another camera's: an organized cloud of another size or whose points
/// are not at their pixels; points that are far more or far fewer than pixels; pixels with several depths.
std::vector<Finding> doubts_of_camera(const PointCloud& cloud, const KnownScene& known, const Model& model);

/// Warnings that the support seems to be elsewhere or of another size: points inside its floor or walls, a
/// floor at another height, a rim that is not there.
std::vector<Finding> doubts_of_support(const PointCloud& cloud, const KnownScene& known, const Model& model);

}  // namespace tanglebin
