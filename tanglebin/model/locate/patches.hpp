#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room. Everything is in the camera's frame.
namespace tanglebin {

/// The plane through the points of a small tile of the image.
struct FlatPatch {
  Eigen::Vector3d centre;  ///< m
  Eigen::Vector3d normal;  ///< unit, towards the camera
  double noise;            ///< m, RMS distance of the points from the plane
  double area;             ///< m², of surface
};

/// A patch for each tile of at least 10 pixels and 8 mm that has enough points and is roughly flat.
std::vector<FlatPatch> patches_of(const SensorView& view);

/// A plane that many patches lie on.
struct FlatPlane {
  Eigen::Vector3d normal;  ///< unit, towards the camera
  double offset;           ///< m; normal · point for its points: negative
  double area;             ///< m², of its patches
  double noise;            ///< m, median of its patches' noise
};

/// The planes that the patches lie on, from the largest to the smallest: at most twelve, each with at
/// least 0.5 % of the area. Deterministic.
std::vector<FlatPlane> planes_of(const std::vector<FlatPatch>& patches);

}  // namespace tanglebin
