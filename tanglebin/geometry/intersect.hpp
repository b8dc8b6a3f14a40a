#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/geometry/ray.hpp"

namespace tanglebin {

/// Where a ray first crosses a surface.
struct SurfaceHit {
  double distance;         ///< m, from the ray's origin
  Eigen::Vector3d normal;  ///< outward unit normal of the solid there
};

/// The first crossing of a capsule's surface: where the ray enters the solid or, if it starts inside, where
/// it leaves. Nothing where the ray misses or the capsule lies behind it. A capsule whose ends coincide is a
/// sphere. Closed form in double precision: for a capsule of some centimetres metres away, the point found
/// lies within 1e-12 m of the surface, also at grazing incidence and along the axis.
std::optional<SurfaceHit> ray_capsule(const Ray& ray, const Capsule& capsule);

/// rad, between a surface's normal and the direction back along the ray.
double incidence_of(const Ray& ray, const Eigen::Vector3d& normal);

/// The same as ray_capsule() for an axis-aligned box. A ray that lies in the plane of a face touches the box.
std::optional<SurfaceHit> ray_box(const Ray& ray, const Eigen::AlignedBox3d& box);

}  // namespace tanglebin
