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
  std::optional<LengthRange> radius;  ///< empty: to be estimated
  std::optional<LengthRange> length;  ///< of a chain
  SegmentTree tree;                   ///< of a tree; empty for a chain
  bool flat_ends = false;             ///< cut flat, not round
};

/// What is known about the camera and its clouds. What is not known is empty.
struct SceneCamera {
  std::optional<Intrinsics> intrinsics;
  std::optional<Eigen::Isometry3d>
      pose;                         ///< camera frame → world frame; empty: the world is the camera's frame
  std::optional<CloudFrame> frame;  ///< of the cloud's points
  std::optional<double> unit;       ///< m, of the cloud's coordinates: 1 or 0.001
};

/// What is known about a scene before its cloud is looked at: a scene file's contents (docs/formats.md).
struct Scene {
  SceneCamera camera;
  std::optional<Support> support;
  std::vector<TubeClass> tubes;
};

}  // namespace tanglebin
