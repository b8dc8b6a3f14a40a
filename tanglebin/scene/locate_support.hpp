#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/locate/locate.hpp"
#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// A scene whose support was found.
struct LocatedScene {
  /// As given, with the pose of its support. A bin's wall that was not given is as measured, if it was.
  Scene scene;
  Located located;                  ///< what was found, in the world frame
  std::vector<std::string> notes;   ///< of resolve_without_tubes()
  std::vector<std::string> doubts;  ///< why the pose may be less good than usual
};

/// Finds the scene's support in a cloud, whose coordinates are as its file has them (locate.hpp). Throws
/// InputError as resolve_without_tubes() and locate() do, and if the scene has no support.
LocatedScene locate_support(const Scene& scene, const PointCloud& cloud);

}  // namespace tanglebin
