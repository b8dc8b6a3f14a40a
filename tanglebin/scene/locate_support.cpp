#include "tanglebin/scene/locate_support.hpp"

#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/scene/resolve_scene.hpp"

namespace tanglebin {

namespace {

bool means_several_places(const InputError& error) {
  return error.place().field == "support.position";
}

std::optional<Located> located_unless_refused(const PointCloud& cloud, const Support& bin,
                                              const Camera& camera) {
  try {
    return locate(cloud, bin, camera);
  } catch (const InputError& error) {
    if (means_several_places(error)) throw;
    return std::nullopt;
  }
}

// Where a wall is thinner than assumed, what is behind it is seen where the rim should be.
Located locate_with_assumed_wall(const PointCloud& cloud, Support bin, const Camera& camera) {
  try {
    return locate(cloud, bin, camera);
  } catch (const InputError& error) {
    if (error.place().field != "support") throw;
    constexpr double thin = 0.003;  // m
    bin.bin.wall = thin;
    std::optional<Located> located = located_unless_refused(cloud, bin, camera);
    if (!located) throw;
    return *std::move(located);
  }
}

// With the wall that was measured, the bin may fit elsewhere too.
Located locate_with_any_wall(const PointCloud& cloud, Support bin, const Camera& camera) {
  Located located = locate_with_assumed_wall(cloud, bin, camera);
  bin.bin.wall = located.measured.wall;
  if (std::optional<Located> again = located_unless_refused(cloud, bin, camera)) located = *std::move(again);
  located.support.bin.wall = located.measured.wall;
  return located;
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
