#include "tanglebin/scene/locate_support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/cloud/depth_scales.hpp"
#include "tanglebin/scene/resolve_scene.hpp"

namespace tanglebin {

namespace {

// Whether another wall may do better: not where several bins are seen, or the cloud is no view of one.
bool is_not_located(const InputError& error) {
  return error.place().field == "support";
}

std::optional<Located> located_unless_refused(const PointCloud& cloud, const Support& bin,
                                              const Camera& camera) {
  try {
    return locate(cloud, bin, camera);
  } catch (const InputError& error) {
    if (!is_not_located(error)) throw;
    return std::nullopt;
  }
}

// Where a wall is thinner than assumed, what is behind it is seen where the rim should be; where it is much
// thicker, its outer edge is not found.
Located locate_with_assumed_wall(const PointCloud& cloud, Support bin, const Camera& camera) {
  std::optional<Located> first;
  std::optional<InputError> refusal;
  for (const double wall : {bin.bin.wall, 0.01, 0.003}) {  // m
    bin.bin.wall = wall;
    try {
      Located located = locate(cloud, bin, camera);
      if (located.is_wall_measured) return located;
      if (!first) first = std::move(located);
    } catch (const InputError& error) {
      if (!is_not_located(error)) throw;
      if (!refusal) refusal = error;
    }
  }
  if (!first) throw InputError(*refusal);
  return *std::move(first);
}

// With the wall that was measured, the bin may fit elsewhere too.
Located locate_with_any_wall(const PointCloud& cloud, Support bin, const Camera& camera) {
  Located located = locate_with_assumed_wall(cloud, bin, camera);
  if (!located.is_wall_measured) return located;
  bin.bin.wall = located.measured.wall;
  if (std::optional<Located> again = located_unless_refused(cloud, bin, camera)) located = *std::move(again);
  located.support.bin.wall = located.measured.wall;
  return located;
}

// As it would be if the depth image that it was had this scale; m, world frame.
PointCloud with_depth_scale(PointCloud cloud, double scale, const Eigen::Isometry3d& camera) {
  const Eigen::Vector3f centre = camera.translation().cast<float>();
  const auto factor = static_cast<float>(*cloud.depth_scale / scale);
  for (Eigen::Vector3f& point : cloud.points) point = centre + factor * (point - centre);
  return cloud;
}

bool is_located(const PointCloud& cloud, const Support& bin, const Camera& camera) {
  try {
    locate(cloud, bin, camera);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Of a plane, every scale would show one.
std::optional<double> depth_scale_that_shows(const Support& bin, const PointCloud& cloud,
                                             const Camera& camera) {
  if (!cloud.depth_scale || bin.shape != Support::Shape::bin) return std::nullopt;
  for (const double scale : other_depth_scales(*cloud.depth_scale)) {
    if (is_located(with_depth_scale(cloud, scale, camera.pose), bin, camera)) return scale;
  }
  return std::nullopt;
}

// If the support is not in the cloud, the depth scale may be wrong.
Located located_or_scale_named(const PointCloud& cloud, const Support& support, const Camera& camera,
                               bool is_wall_unknown) {
  try {
    return is_wall_unknown ? locate_with_any_wall(cloud, support, camera) : locate(cloud, support, camera);
  } catch (const InputError& error) {
    if (!is_not_located(error)) throw;
    const std::optional<double> scale = depth_scale_that_shows(support, cloud, camera);
    if (!scale) throw;
    throw InputError(error.place(), fmt::format("{}; it would fit with depth_scale = {:.6g} in [camera]",
                                                error.problem(), *scale));
  }
}

// Whether the floor is less even than rim and walls are.
std::optional<std::string> doubt_of_floor(const std::vector<LocatedPart>& parts, double margin) {
  const auto floor = std::ranges::find(parts, "floor", &LocatedPart::name);
  if (floor == parts.end()) return std::nullopt;
  std::vector<double> noises;
  for (const LocatedPart& part : parts) {
    if (part.name != "floor") noises.push_back(part.noise);
  }
  if (noises.empty()) return std::nullopt;
  constexpr double uneven = 0.001;  // m
  constexpr double times = 3;
  const double others = median(std::move(noises));
  if (floor->noise < std::max(uneven, times * others)) return std::nullopt;
  constexpr double nearly = 0.8;  // a larger margin lets more of a floor count
  const std::string remedy = margin < nearly * floor->noise
                                 ? fmt::format("; give margin = {:.3f} in [support]", floor->noise + 0.0005)
                                 : "";
  return fmt::format(
      "the floor is uneven by {:.1f} mm, rim and walls by {:.1f} mm: if it bulges or is dirty, the pose is "
      "off by as much{}",
      1000 * floor->noise, 1000 * others, remedy);
}

std::vector<std::string> doubts_of(const Located& located, double margin, bool is_wall_unknown) {
  std::vector<std::string> doubts;
  if (const auto doubt = doubt_of_floor(located.parts, margin)) doubts.push_back(*doubt);
  if (is_wall_unknown && !located.is_wall_measured) {
    doubts.emplace_back(
        "how thick the walls are is not seen: give wall in [support], or the rim may be taken "
        "for tubes");
  }
  return doubts;
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
  Located located = located_or_scale_named(resolved.cloud, support, camera, is_wall_unknown);
  LocatedScene result{scene, std::move(located), std::move(resolved.notes), {}};
  result.doubts = doubts_of(result.located, support.margin, is_wall_unknown);
  result.scene.support = result.located.support;
  result.scene.wall_is_given = scene.wall_is_given || result.located.is_wall_measured;
  if (!result.scene.wall_is_given) result.scene.support->bin.wall = support.bin.wall;
  return result;
}

}  // namespace tanglebin
