#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/surface_patches.hpp"
#include "tanglebin/model/scene/pixel_grid.hpp"

// Internal to the room.
namespace tanglebin {

/// What two points of a cloud, with the surface around them, say of the radius if they are on one cylinder.
struct PairRadius {
  std::size_t first;  ///< the points' places in the grid
  std::size_t second;
  float radius;  ///< m
};

/// Patches that are small enough for what follows.
inline constexpr PatchSettings pair_patches{.neighbours = 20, .reach_min = 0.25};

/// Of all pairs of a grid's points that are 0.8 of this radius (m) apart, along rows and columns, and on
/// which the surface's normals differ: as many as there are points, about.
std::vector<PairRadius> radii_of_pairs(const PixelGrid& grid, double radius,
                                       const PatchSettings& settings = pair_patches);

}  // namespace tanglebin
