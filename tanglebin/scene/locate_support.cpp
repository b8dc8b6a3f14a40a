#include "tanglebin/scene/locate_support.hpp"

#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/scene/resolve_scene.hpp"

namespace tanglebin {

namespace {

// Where a wall is thinner than assumed, what is behind it is seen where the rim should be. A wall that is
// thicker than assumed does no harm.
Located locate_with_any_wall(const PointCloud& cloud, Support bin, const Camera& camera) {
  const auto measured = [&] {
    Located located = locate(cloud, bin, camera);
    located.support.bin.wall = located.measured.wall;
    return located;
  };
  try {
    return measured();
  } catch (const InputError& error) {
    if (error.place().field != "support") throw;
    constexpr double thin = 0.003;  // m
    bin.bin.wall = thin;
    try {
      return measured();
    } catch (const InputError&) {
      throw error;
    }
  }
}

}  // namespace

LocatedScene locate_support(const Scene& scene, const PointCloud& cloud) {
  if (!scene.support)
    throw InputError({.file = "", .line = 0, .field = "support"}, "nothing known of a bin or plane",
                     "a scene file whose [support] has its shape, and the sizes of a bin (--scene)");
  ResolvedScene resolved = resolve_without_tubes(scene, cloud);
  const Support& support = *scene.support;
  const Camera& camera = resolved.known.camera;
  const bool is_wall_unknown = support.shape == Support::Shape::bin && !scene.wall_is_given;
  Located located = is_wall_unknown ? locate_with_any_wall(resolved.cloud, support, camera)
                                    : locate(resolved.cloud, support, camera);
  LocatedScene result{scene, std::move(located), std::move(resolved.notes)};
  result.scene.support = result.located.support;
  result.scene.wall_is_given = true;
  return result;
}

}  // namespace tanglebin
