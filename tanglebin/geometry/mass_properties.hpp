#pragma once

#include <Eigen/Core>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Of a solid of uniform density.
struct MassProperties {
  double mass;              ///< kg
  double volume;            ///< m³
  Eigen::Vector3d centre;   ///< m, centre of mass in the tube's frame (world)
  Eigen::Matrix3d inertia;  ///< kg m², about the centre of mass, world axes
};

/// The smallest and the largest mass of a tube, kg, with which the physics engine works.
inline constexpr double lightest_tube = 1e-9;
inline constexpr double heaviest_tube = 1e9;

/// Mass properties of the tube as a uniform solid of mass tube.mass that fills the union of its capsules.
/// Overlapping space counts once. By quadrature; mass_properties.cpp documents the error and a test checks
/// it.
MassProperties mass_properties(const Tube& tube);

}  // namespace tanglebin
