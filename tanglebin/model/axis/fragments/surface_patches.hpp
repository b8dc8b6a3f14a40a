#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/pixel_grid.hpp"

namespace tanglebin {

/// The surface around a point: a plane through its neighbours.
struct Patch {
  Eigen::Vector3f mean;    ///< of the neighbours, m, relative to the point
  Eigen::Vector3f normal;  ///< unit, towards the sensor
  float roughness;         ///< the neighbours' variance about the plane, reaches²
  float breadth;           ///< the smaller of their two variances within the plane, reaches²
};

/// The reach, m, within which points have about the desired number of neighbours, for tubes of this radius
/// (m).
float suitable_reach(const PixelGrid& grid, double radius, const PatchSettings& settings);

/// The patch around each point of the grid, from its neighbours within the reach (m). None if these are too
/// few, on a line, or not on a plane, as where two surfaces meet. Whatever else is in the cloud, a patch of a
/// tube of this radius (m) is as good as a plane.
std::vector<std::optional<Patch>> surface_patches(const PixelGrid& grid, float reach, double radius,
                                                  const PatchSettings& settings);

}  // namespace tanglebin
