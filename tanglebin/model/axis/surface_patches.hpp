#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/scene/pixel_grid.hpp"

namespace tanglebin {

/// The surface around a point: the plane through its neighbours.
struct Patch {
  Eigen::Vector3f mean;    ///< of the neighbours, m, relative to the point
  Eigen::Vector3f normal;  ///< unit, towards the sensor
  float roughness;         ///< the neighbours' variance about the plane, reaches²
  float breadth;           ///< the lesser of their two variances in it, reaches²
};

/// The reach, m, within which points have about as many neighbours as wanted; for tubes of this radius (m).
float suitable_reach(const PixelGrid& grid, double radius, const PatchSettings& settings);

/// The patch around each point of the grid, of its neighbours in this reach (m). None where these are too
/// few, or on a line, or on no plane, as where two surfaces meet.
std::vector<std::optional<Patch>> surface_patches(const PixelGrid& grid, float reach,
                                                  const PatchSettings& settings);

}  // namespace tanglebin
