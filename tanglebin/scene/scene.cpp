#include "tanglebin/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/millimetres.hpp"

namespace tanglebin {
namespace {

// Calls `check` with the names of a scene file's tables in its errors.
void check_under(std::string_view table, const std::function<void()>& check) {
  try {
    check();
  } catch (const InputError& error) {
    const std::string& field = error.place().field;
    throw InputError(
        {"", 0, fmt::format("{}{}", table, field.substr(std::min(field.find('.'), field.size())))},
        error.problem());
  }
}

void validate_range(const LengthRange& range, double least, double most, const std::string& field) {
  expect(!(range.min > range.max), field, fmt::format("min = {} and max = {}", range.min, range.max),
         "a min of at most max");
  expect(range.min >= least && range.max <= most && range.max > 0, field,
         range.min == range.max ? fmt::format("{} m", range.min)
                                : fmt::format("{} to {} m", range.min, range.max),
         fmt::format("{} to {} m{}", least, most, hint_of_millimetres(range.max, most)));
}

void validate(const SceneCamera& camera) {
  if (camera.intrinsics) {
    Intrinsics intrinsics = *camera.intrinsics;
    if (intrinsics.width == 0 && intrinsics.height == 0) intrinsics.width = intrinsics.height = 1;
    check_under("camera", [&] { validate(camera_with(intrinsics, Eigen::Isometry3d::Identity())); });
  }
  if (camera.pose) check_under("camera", [&] { validate(camera_with({1, 1, 1, 1, 0, 0}, *camera.pose)); });
  if (camera.unit)
    expect(*camera.unit == 1 || *camera.unit == 0.001, "camera.unit", fmt::format("{} m", *camera.unit),
           "1 or 0.001 m");
  if (camera.depth_scale)
    expect(std::isfinite(*camera.depth_scale) && *camera.depth_scale > 0, "camera.depth_scale",
           fmt::format("{}", *camera.depth_scale), "a positive number of steps per metre");
}

void validate(const TubeClass& tubes, const std::string& where) {
  constexpr double longest = 1000;
  if (tubes.radius) validate_range(*tubes.radius, thinnest_radius, thickest_radius, where + ".radius");
  if (tubes.length) validate_range(*tubes.length, 0, longest, where + ".length");
  if (tubes.tree.empty()) return;
  validate(tubes.tree, where + ".segment");
  expect(!tubes.length, where + ".length", "a length", "none, because there are segments");
}

}  // namespace

void validate(const Scene& scene) {
  validate(scene.camera);
  if (scene.support) check_under("support", [&] { validate(*scene.support); });
  std::vector<TubeKind> kinds;
  for (std::size_t i = 0; i < scene.tubes.size(); ++i) {
    validate(scene.tubes[i], fmt::format("tube[{}]", i));
    kinds.push_back(kind_of(scene.tubes[i]));
  }
  validate_together(kinds, scene.support.value_or(Support{.shape = Support::Shape::nothing}), "tube");
}

TubeKind kind_of(const TubeClass& tubes) {
  TubeKind kind{.radius = 0, .segments = tubes.tree, .length_min = 0, .flat_ends = tubes.flat_ends};
  if (tubes.radius && tubes.radius->min == tubes.radius->max) kind.radius = tubes.radius->min;
  if (!tubes.tree.empty()) return kind;
  const double longest = tubes.length ? tubes.length->max : std::numeric_limits<double>::infinity();
  kind.segments = {{.from = 1, .to = 2, .length = longest}};
  kind.length_min = tubes.length ? tubes.length->min : 0;
  return kind;
}

bool is_empty(const Scene& scene) {
  const auto& [intrinsics, pose, frame, unit, depth_scale] = scene.camera;
  return !intrinsics && !pose && !frame && !unit && !depth_scale && !scene.support && scene.tubes.empty();
}

Scene scene_of(const KnownScene& known) {
  Scene scene{.camera = {.intrinsics = intrinsics_of(known.camera),
                         .pose = known.camera.pose,
                         .frame = CloudFrame::world,
                         .unit = 1,
                         .depth_scale = {}},
              .support = known.support,
              .tubes = {}};
  for (const TubeKind& kind : known.kinds) {
    TubeClass tubes{.radius = LengthRange{kind.radius, kind.radius}, .flat_ends = kind.flat_ends};
    if (kind.branches()) {
      tubes.tree = kind.segments;
    } else if (kind.length_is_known()) {
      tubes.length = LengthRange{kind.length_min, kind.length()};
    }
    scene.tubes.push_back(tubes);
  }
  return scene;
}

Scene overridden(Scene scene, const Scene& more) {
  const auto override_with = [](auto& value, const auto& other) {
    if (other) value = other;
  };
  override_with(scene.camera.intrinsics, more.camera.intrinsics);
  override_with(scene.camera.pose, more.camera.pose);
  override_with(scene.camera.frame, more.camera.frame);
  override_with(scene.camera.unit, more.camera.unit);
  override_with(scene.camera.depth_scale, more.camera.depth_scale);
  if (more.support) {
    scene.support = more.support;
    scene.wall_is_given = more.wall_is_given;
  }
  if (!more.tubes.empty()) scene.tubes = more.tubes;
  return scene;
}

}  // namespace tanglebin
