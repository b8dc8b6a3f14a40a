#include "tanglebin/export/extent.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// How a surface ends at a node: with a sphere, or at a flat end with the rim, a circle across the axis. The
/// surface is within the convex hull of all these.
struct End {
  Vector3d centre;
  double radius;
  bool is_rim;
  Vector3d axis = Vector3d::UnitZ();  ///< of a rim
};

std::vector<End> ends_of(const Tube& tube) {
  std::vector<End> ends;
  for (const Capsule& capsule : capsules(tube)) {
    const Vector3d axis = (capsule.b - capsule.a).normalized();
    ends.push_back({capsule.a, capsule.radius, capsule.flat_at_a, axis});
    ends.push_back({capsule.b, capsule.radius, capsule.flat_at_b, axis});
  }
  return ends;
}

Eigen::AlignedBox3d box_of(const End& end) {
  const Vector3d reach = end.is_rim ? Vector3d((1 - end.axis.array().square()).max(0).sqrt() * end.radius)
                                    : Vector3d::Constant(end.radius);
  return {end.centre - reach, end.centre + reach};
}

Vector3d farthest_on_rim(const End& rim, const Vector3d& from) {
  const Vector3d away = rim.centre - from;
  const Vector3d across = away - away.dot(rim.axis) * rim.axis;
  const double length = across.norm();
  // From a point on the axis, all of the rim is as far.
  return rim.centre + rim.radius * (length > 0 ? Vector3d(across / length) : rim.axis.unitOrthogonal());
}

// From either rim to the farthest point of the other, until that is the way back.
double longest_between_rims(const End& first, const End& second) {
  constexpr int enough = 30;
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double way : {-second.radius, second.radius}) {
      Vector3d here = farthest_on_rim(first, second.centre + way * Vector3d::Unit(axis));
      Vector3d there = here;
      for (int i = 0; i < enough; ++i) {
        there = farthest_on_rim(second, here);
        here = farthest_on_rim(first, there);
      }
      longest = std::max(longest, (there - here).norm());
    }
  }
  return longest;
}

double longest_between(const End& first, const End& second) {
  if (first.is_rim && second.is_rim) return longest_between_rims(first, second);
  const Vector3d farthest = first.is_rim ? farthest_on_rim(first, second.centre) : first.centre;
  const Vector3d other = second.is_rim ? farthest_on_rim(second, first.centre) : second.centre;
  const double beyond = (first.is_rim ? 0 : first.radius) + (second.is_rim ? 0 : second.radius);
  return (farthest - other).norm() + beyond;
}

}  // namespace

Extent extent_of(const Tube& tube) {
  Extent extent;
  const std::vector<End> ends = ends_of(tube);
  for (const End& end : ends) {
    extent.box.extend(box_of(end));
    for (const End& other : ends) extent.diameter = std::max(extent.diameter, longest_between(end, other));
  }
  return extent;
}

}  // namespace tanglebin
