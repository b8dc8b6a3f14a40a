#pragma once

#include <cstddef>
#include <optional>

#include "tanglebin/model/scene/pixel_grid.hpp"

// Internal to the room.
namespace tanglebin {

/// The cylinder through the surface around a point.
struct CylinderFit {
  double radius;  ///< m
  double error;   ///< m, standard error of the radius, from the residuals of the points
};

/// Fits a cylinder by least squares to the points within `reach` (m) of a point of the grid: to their
/// positions, since sensors smooth normals, along their rays, since there is the noise. Points on surfaces
/// that fall away from the view do not count: there, real sensors blend a surface with what is behind it.
/// None if these points are too few, or not on a cylinder that bulges towards the sensor with a radius of
/// about the reach.
std::optional<CylinderFit> fit_cylinder(const PixelGrid& grid, std::size_t item, double reach);

}  // namespace tanglebin
