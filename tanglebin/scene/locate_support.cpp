#include "tanglebin/scene/locate_support.hpp"

#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/scene/resolve_scene.hpp"

namespace tanglebin {

LocatedScene locate_support(const Scene& scene, const PointCloud& cloud) {
  if (!scene.support)
    throw InputError({.file = "", .line = 0, .field = "support"}, "nothing known of a bin or plane",
                     "a scene file whose [support] has its shape, and the sizes of a bin (--scene)");
  ResolvedScene resolved = resolve_without_tubes(scene, cloud);
  Located located = locate(resolved.cloud, *scene.support, resolved.known.camera);
  LocatedScene result{scene, std::move(located), std::move(resolved.notes)};
  result.scene.support = result.located.support;
  return result;
}

}  // namespace tanglebin
