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

/// Mass properties of the tube as a uniform solid of mass tube.mass that fills the union of its capsules.
/// Overlapping space counts once. By quadrature; mass_properties.cpp documents the error and a test checks
/// it.
MassProperties mass_properties(const Tube& tube);

}  // namespace tanglebin
