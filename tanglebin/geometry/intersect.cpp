#include "tanglebin/geometry/intersect.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/geometry/interval.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// The part of the line start + t direction (a unit vector) inside the sphere around the origin.
Interval inside_sphere(const Vector3d& start, const Vector3d& direction, double radius) {
  const double middle = -start.dot(direction);
  const double half_chord2 = radius * radius - (start + middle * direction).squaredNorm();
  if (half_chord2 < 0) return {};
  const double half_chord = std::sqrt(half_chord2);
  return {middle - half_chord, middle + half_chord};
}

/// Keeps the part of `inside`, on the line start + t direction, that is on the inner side of the plane
/// through a flat end. The origin is the capsule's centre; `half_axis` points to that end. Tells where the
/// plane cuts.
void cut(Interval& inside, double& face, const Vector3d& start, const Vector3d& direction,
         const Vector3d& half_axis) {
  const double slope = direction.dot(half_axis);
  const double beyond = start.dot(half_axis) - half_axis.squaredNorm();
  if (slope == 0) {
    if (beyond > 0) inside = {};
    return;
  }
  face = -beyond / slope;
  if (slope > 0) {
    inside.high = std::min(inside.high, face);
  } else {
    inside.low = std::max(inside.low, face);
  }
}

}  // namespace

std::optional<SurfaceHit> ray_capsule(const Ray& ray, const Capsule& capsule) {
  const Vector3d& d = ray.direction;
  const double radius = capsule.radius;
  const Vector3d half_axis = 0.5 * (capsule.b - capsule.a);
  const Vector3d centre = 0.5 * (capsule.a + capsule.b);
  const double h2 = half_axis.squaredNorm();

  // Measured from the ray's point closest to the capsule's centre, the numbers below are no larger than the
  // capsule, however far away the ray starts, so there is little cancellation.
  const double shift = (centre - ray.origin).dot(d);
  const Vector3d start = ray.origin + shift * d - centre;
  const auto inside_end = [&](double side) {
    return inside_sphere(start - std::copysign(1.0, side) * half_axis, d, radius);
  };

  // Inside the infinite cylinder |(start + t d) x h| <= radius |h|, where h is the half axis. With n = d x h
  // this is n² t² + 2 t (start x h)·n + (start x h)² <= radius² h², and the discriminant is h² (radius² n² −
  // (start·n)²).
  const Vector3d n = d.cross(half_axis);
  const double n2 = n.squaredNorm();
  const double start_n = start.dot(n);
  const double reduced_discriminant = radius * radius * n2 - start_n * start_n;
  if (reduced_discriminant < 0) return std::nullopt;

  Interval t{};
  if (n2 > 0) {
    const double middle = -start.cross(half_axis).dot(n) / n2;
    const double half_chord = std::sqrt(h2 * reduced_discriminant) / n2;
    t = {middle - half_chord, middle + half_chord};
    // A ray that crosses the cylinder's surface beyond an end can only meet the capsule in that end's sphere.
    const auto height = [&](double at) { return (start + at * d).dot(half_axis); };
    const double enter_height = height(t.low);
    const double leave_height = height(t.high);
    if (std::abs(enter_height) > h2) t.low = inside_end(enter_height).low;
    if (std::abs(leave_height) > h2) t.high = inside_end(leave_height).high;
  } else {
    // The ray runs along the axis, or the capsule is a sphere: it can only meet the spheres at the ends.
    const Interval first = inside_end(-1);
    const Interval second = inside_end(1);
    t = {std::min(first.low, second.low), std::max(first.high, second.high)};
  }
  double face_a = infinity;
  double face_b = infinity;
  if (capsule.flat_at_a) cut(t, face_a, start, d, -half_axis);
  if (capsule.flat_at_b) cut(t, face_b, start, d, half_axis);
  if (t.low > t.high || t.high + shift < 0) return std::nullopt;

  const double hit = t.low + shift >= 0 ? t.low : t.high;
  if (hit == face_a) return SurfaceHit{hit + shift, -half_axis.normalized()};
  if (hit == face_b) return SurfaceHit{hit + shift, half_axis.normalized()};
  const Vector3d point = start + hit * d;
  const double along = h2 > 0 ? std::clamp(point.dot(half_axis) / h2, -1.0, 1.0) : 0.0;
  return SurfaceHit{hit + shift, (point - along * half_axis) / radius};
}

double incidence_of(const Ray& ray, const Vector3d& normal) {
  return std::acos(std::clamp(-normal.dot(ray.direction), -1.0, 1.0));
}

std::optional<SurfaceHit> ray_box(const Ray& ray, const Eigen::AlignedBox3d& box) {
  Interval t = {-infinity, infinity};
  Eigen::Index enter_axis = 0;
  Eigen::Index leave_axis = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    const double to_min = box.min()[axis] - ray.origin[axis];
    const double to_max = box.max()[axis] - ray.origin[axis];
    if (d == 0) {
      if (to_min > 0 || to_max < 0) return std::nullopt;
      continue;
    }
    const double inverse = 1 / d;
    const double enter = (d > 0 ? to_min : to_max) * inverse;
    const double leave = (d > 0 ? to_max : to_min) * inverse;
    if (enter > t.low) {
      t.low = enter;
      enter_axis = axis;
    }
    if (leave < t.high) {
      t.high = leave;
      leave_axis = axis;
    }
  }
  if (t.low > t.high || t.high < 0) return std::nullopt;

  const bool from_outside = t.low >= 0;
  const Eigen::Index axis = from_outside ? enter_axis : leave_axis;
  const bool along_axis = ray.direction[axis] > 0;
  SurfaceHit hit{from_outside ? t.low : t.high, Vector3d::Zero()};
  hit.normal[axis] = along_axis == from_outside ? -1.0 : 1.0;
  return hit;
}

}  // namespace tanglebin
