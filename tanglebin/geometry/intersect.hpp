#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/geometry/ray.hpp"

namespace tanglebin {

/// The point where a ray first crosses a surface.
struct SurfaceHit {
  double distance;         ///< m, from the ray's origin
  Eigen::Vector3d normal;  ///< outward unit normal of the solid
};

/// The first crossing of a capsule's surface: where the ray enters the solid or, if it starts inside, where
/// it leaves. None if the ray misses, or if the capsule is behind it. A capsule whose ends coincide is a
/// sphere. A flat end is a disc. Closed form, double precision: for a capsule of a few centimetres at a
/// distance of metres, the point found is within 1e-12 m of the surface, even at grazing incidence and along
/// the axis.
std::optional<SurfaceHit> ray_capsule(const Ray& ray, const Capsule& capsule);

/// The angle between a surface's normal and the direction back along the ray, rad.
double incidence_of(const Ray& ray, const Eigen::Vector3d& normal);

/// Like ray_capsule(), for an axis-aligned box. A ray in the plane of a face touches the box.
std::optional<SurfaceHit> ray_box(const Ray& ray, const Eigen::AlignedBox3d& box);

}  // namespace tanglebin
