#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// A cloud, and all that a method must know of it.
struct ResolvedScene {
  PointCloud cloud;                ///< the points alone, in their order: m, world frame
  KnownScene known;                ///< in the world frame
  std::vector<std::string> notes;  ///< what was estimated or taken for granted, a sentence each
};

/// Finds out from a cloud, whose coordinates are as its file has them, what a scene does not say:
/// - the unit, from the cloud's size;
/// - the camera's pose: the cloud's viewpoint, or else the world frame is the camera's;
/// - the frame of the points: the one in which the camera sees them;
/// - the intrinsics, from an organized cloud, whose rows and columns are the image's;
/// - the support: nothing;
/// - the radius of a single class of tubes (estimate_radius()); a length may stay unknown.
/// Throws InputError naming what is missing, and how to give it, if the cloud does not show it; as
/// validate(KnownScene) does; and, unless the support is a bin, if a length is more than a hundred times the
/// cloud's size. Calls `at_place` as estimate_radius() does.
ResolvedScene resolve(
    const Scene& scene, const PointCloud& cloud, const std::function<void()>& at_place = [] {});

/// The same without the tubes: the kinds are the default's.
ResolvedScene resolve_without_tubes(const Scene& scene, const PointCloud& cloud);

}  // namespace tanglebin
