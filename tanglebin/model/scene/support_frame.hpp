#pragma once

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

// The methods work in the support's frame, in which a bin is a union of axis-aligned boxes.
namespace tanglebin {

/// A cloud (m) and what is known of it, in one frame.
struct Seen {
  PointCloud cloud;
  KnownScene known;
};

/// Whether the world frame is the support's frame.
bool is_in_support_frame(const KnownScene& known);

/// Moves a cloud from the world frame into the support's frame, the camera with it. Without a support, the
/// origin moves to the camera. Of the cloud, only the points are taken along.
Seen in_support_frame(const PointCloud& cloud, const KnownScene& known);

/// Moves the tubes of a model that was found in the support's frame back into the world frame.
Model in_world_frame(Model model, const KnownScene& known);

}  // namespace tanglebin
