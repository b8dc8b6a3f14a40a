#pragma once

#include <Eigen/Core>

namespace tanglebin {

/// All points within `radius` of the segment a–b: a cylinder with a hemisphere at each end. In metres. It may
/// be cut flat at an end, by the plane through a or b across the axis; unless said otherwise, functions below
/// take no notice of that.
struct Capsule {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  double radius;
  bool flat_at_a = false;
  bool flat_at_b = false;
};

/// The longest capsule with round ends on the same axis that is inside one with flat ends: it ends where that
/// is cut. The rim of a flat end stands out of it by (√2 − 1) radius. One that is shorter than its round ends
/// shrinks to a sphere, which may stand out of it.
Capsule rounded(const Capsule& capsule);

/// Parameter t in [0, 1] of the point a + t (b − a) on the axis that is nearest to a point.
double nearest_on_axis(const Capsule& capsule, const Eigen::Vector3d& point);

/// The distance of a point from the axis, m.
double axis_distance(const Capsule& capsule, const Eigen::Vector3d& point);

/// The closest points of two segments p0–p1 and q0–q1, at p0 + s (p1 − p0) and q0 + t (q1 − q0) with s and t
/// in [0, 1].
struct SegmentPair {
  double distance;
  double s;
  double t;
};

/// Closest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9). A segment may have length
/// 0.
SegmentPair closest_points(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                           const Eigen::Vector3d& q1);

/// Distance between the surfaces of two capsules, m; if they overlap, minus the depth of the overlap.
double surface_distance(const Capsule& first, const Capsule& second);

}  // namespace tanglebin
