#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/locate/locate.hpp"
#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// A scene whose support was found.
struct LocatedScene {
  Scene scene;  ///< as given, with the pose of its support, and a bin's wall as measured if it was not given
  Located located;                 ///< what was found, in the world frame
  std::vector<std::string> notes;  ///< of resolve_without_tubes()
};

/// Finds the scene's support in a cloud, whose coordinates are as its file has them (locate.hpp). Throws
/// InputError as resolve_without_tubes() and locate() do, and if the scene has no support.
LocatedScene locate_support(const Scene& scene, const PointCloud& cloud);

}  // namespace tanglebin
