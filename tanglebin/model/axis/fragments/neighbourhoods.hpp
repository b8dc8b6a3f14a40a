#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "tanglebin/model/scene/pixel_grid.hpp"

// Internal to the room.
namespace tanglebin {

/// The neighbours of a point, and the plane through them.
struct Neighbourhood {
  int count;               ///< of the neighbours, with the point itself
  Eigen::Vector3f mean;    ///< of the neighbours, m, relative to the point
  Eigen::Vector3f normal;  ///< unit, of the plane, to either side; NaN if all neighbours are on a line
  float roughness;         ///< the neighbours' variance about the plane, reaches²
  float breadth;           ///< the smaller of their two variances within the plane, reaches²
  float length;            ///< the greater one
};

/// As many points are worked on together.
constexpr std::size_t points_at_once = 8;
using PointItems = std::array<std::size_t, points_at_once>;
using Neighbourhoods = std::array<Neighbourhood, points_at_once>;

/// The neighbourhoods of eight of the grid's points: of all points within the reach, m, that are also within
/// as many pixels.
Neighbourhoods neighbourhoods_of(const PixelGrid& grid, const PointItems& items, float reach);

}  // namespace tanglebin
