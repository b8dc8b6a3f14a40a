#pragma once

#include <Eigen/Geometry>

#include "tanglebin/model/locate/patches.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room.
namespace tanglebin {

/// A plane fitted to the points of a view.
struct PlaneFit {
  Eigen::Isometry3d frame;  ///< its frame → camera frame; z towards the camera, origin amid its points
  double residual;          ///< m, RMS distance of its points
  double noise;             ///< m, robust standard deviation of that
  int points;               ///< that the fit used
  double explained;         ///< share of all points that are on it
  double below;             ///< share of all points that are under it
  double parallel;  ///< share, of the surface near it, that is parallel to it: else it cuts through tubes
  Eigen::Matrix3d covariance;  ///< of the height of its origin (m) and its slopes along x and y
};

/// Fits a plane near `plane`. `margin` (m) is by how much the real one may deviate.
PlaneFit fit_plane(const SensorView& view, const FlatPlane& plane, double margin);

}  // namespace tanglebin
