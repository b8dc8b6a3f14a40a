#pragma once

#include <Eigen/Core>
#include <cstddef>
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

/// How densely a surface is covered with patches.
struct PatchSampling {
  float reach = 0;         ///< m, within which points are neighbours
  std::size_t stride = 1;  ///< one point of so many has a patch
};

/// The sampling for tubes of this radius (m) by which points have about the desired number of neighbours and,
/// where the least reach gives them more, each point still is in about that number of patches.
PatchSampling suitable_sampling(const PixelGrid& grid, double radius, const PatchSettings& settings);

/// The patches around the points of the grid, the i-th around the point at item i × stride. None where the
/// neighbours are too few, on a line, or not on a plane, as where two surfaces meet. Whatever else is in the
/// cloud, a patch of a tube of this radius (m) is as good as a plane.
std::vector<std::optional<Patch>> surface_patches(const PixelGrid& grid, const PatchSampling& sampling,
                                                  double radius, const PatchSettings& settings);

}  // namespace tanglebin
