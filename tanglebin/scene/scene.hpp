#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// The frame in which the points of a cloud are given.
enum class CloudFrame { camera, world };

/// The smallest and the largest value that a length may have, m.
struct LengthRange {
  double min;
  double max;

  bool operator==(const LengthRange&) const = default;
};

/// What is known about a class of tubes. What is not known is empty.
struct TubeClass {
  std::optional<LengthRange> radius{};  ///< empty: to be estimated
  std::optional<LengthRange> length{};  ///< of a chain; min 0: only the largest is known
  SegmentTree tree{};                   ///< of a tree; empty for a chain
  bool flat_ends = false;               ///< cut flat, not round

  bool operator==(const TubeClass&) const = default;
};

/// What is known about the camera and its clouds. What is not known is empty.
struct SceneCamera {
  std::optional<Intrinsics> intrinsics{};   ///< width and height 0 if the image's size is not known
  std::optional<Eigen::Isometry3d> pose{};  ///< camera frame → world frame; empty: as resolve() has it
  std::optional<CloudFrame> frame{};        ///< of the cloud's points
  std::optional<double> unit{};             ///< m, of the cloud's coordinates: 1 or 0.001
  std::optional<double> depth_scale{};      ///< steps of a depth image per metre
};

/// What is known about a scene before its cloud is looked at: a scene file's contents (docs/formats.md).
struct Scene {
  SceneCamera camera{};
  std::optional<Support> support{};
  bool wall_is_given = true;       ///< of a bin; if not, locate_support() measures how thick its walls are
  std::vector<TubeClass> tubes{};  ///< empty: one class of which nothing is known
};

/// Throws InputError naming the field that is invalid, as a scene file names it: "camera.fx",
/// "tube[0].radius". Also if tubes are too large for the bin, or two classes have the same radius.
void validate(const Scene& scene);

/// What is known of a class of tubes; a radius of 0 and an infinite length are not known.
TubeKind kind_of(const TubeClass& tubes);

/// Whether nothing is known.
bool is_empty(const Scene& scene);

/// The scene of a cloud, m, world frame, about which all of this is known.
Scene scene_of(const KnownScene& known);

/// The scene, but with all that `more` knows: the intrinsics, the pose, the frame, the unit, the depth scale,
/// the support, all classes of tubes.
Scene overridden(Scene scene, const Scene& more);

}  // namespace tanglebin
