#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// A usual mistake, and what to try.
struct Remedy {
  std::string code;    ///< "frame", "unit", "axes", "pose" or "support"
  std::string advice;  ///< follows "these points …": "would fit in millimetres (--unit mm)"
};

/// The usual mistake without which points (m, world frame; some hundred are enough) would fit the scene, that
/// is be in the camera's image and in the bin, far better than they do: in the other frame, in another unit,
/// with other axes, or with another pose of camera or support. Points of a depth image of integers, whose
/// scale is given, may have another scale instead of another frame, unit or axes. Of several, the simplest.
/// None if the points fit, or if no mistake explains them.
std::optional<Remedy> remedy_for(const std::vector<Eigen::Vector3d>& points, const KnownScene& known,
                                 std::optional<double> depth_scale = std::nullopt);

}  // namespace tanglebin
