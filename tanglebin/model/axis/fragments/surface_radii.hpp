#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments/surface_patches.hpp"
#include "tanglebin/model/scene/pixel_grid.hpp"

// Internal to the room.
namespace tanglebin {

/// The radius that follows from two points and the surface around them if both are on one cylinder.
struct PairRadius {
  std::size_t first;  ///< indices of the points in the grid
  std::size_t second;
  float radius;  ///< m
};

/// Patches small enough for these pairs.
inline constexpr PatchSettings pair_patches{.neighbours = 20, .reach_min = 0.25};

/// The radii from pairs of points in the grid that lie 0.8 of this radius (m) apart, along rows and columns,
/// and whose surface normals differ. There are about as many pairs as points.
std::vector<PairRadius> radii_of_pairs(const PixelGrid& grid, double radius,
                                       const PatchSettings& settings = pair_patches);

}  // namespace tanglebin
