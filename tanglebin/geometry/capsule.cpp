#include "tanglebin/geometry/capsule.hpp"

#include <algorithm>

namespace tanglebin {

Capsule rounded(const Capsule& capsule) {
  const double length = (capsule.b - capsule.a).norm();
  const int flat_ends = (capsule.flat_at_a ? 1 : 0) + (capsule.flat_at_b ? 1 : 0);
  if (flat_ends == 0 || length == 0) return {capsule.a, capsule.b, capsule.radius};
  const Eigen::Vector3d inward =
      std::min(capsule.radius, length / flat_ends) / length * (capsule.b - capsule.a);
  return {.a = capsule.flat_at_a ? capsule.a + inward : capsule.a,
          .b = capsule.flat_at_b ? capsule.b - inward : capsule.b,
          .radius = capsule.radius};
}

double nearest_on_axis(const Capsule& capsule, const Eigen::Vector3d& point) {
  const Eigen::Vector3d axis = capsule.b - capsule.a;
  const double square = axis.squaredNorm();
  return square > 0 ? std::clamp((point - capsule.a).dot(axis) / square, 0.0, 1.0) : 0.0;
}

double axis_distance(const Capsule& capsule, const Eigen::Vector3d& point) {
  const double t = nearest_on_axis(capsule, point);
  return (capsule.a + t * (capsule.b - capsule.a) - point).norm();
}

SegmentPair closest_points(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                           const Eigen::Vector3d& q1) {
  const Eigen::Vector3d p = p1 - p0;
  const Eigen::Vector3d q = q1 - q0;
  const Eigen::Vector3d r = p0 - q0;
  const double pp = p.squaredNorm();
  const double qq = q.squaredNorm();
  const double pq = p.dot(q);
  const double pr = p.dot(r);
  const double qr = q.dot(r);

  // The parameter of the point on one segment nearest to a given point of the other; 0 if the segment is a
  // point.
  const auto nearest_on_p = [&](double t) { return pp > 0 ? std::clamp((pq * t - pr) / pp, 0.0, 1.0) : 0.0; };
  const auto nearest_on_q = [&](double s) { return qq > 0 ? std::clamp((pq * s + qr) / qq, 0.0, 1.0) : 0.0; };

  const double determinant = pp * qq - pq * pq;  // 0 for parallel segments: any s will do as a start
  double s = determinant > 0 ? std::clamp((pq * qr - qq * pr) / determinant, 0.0, 1.0) : 0.0;
  const double t = nearest_on_q(s);
  s = nearest_on_p(t);
  return {(r + s * p - t * q).norm(), s, t};
}

double surface_distance(const Capsule& first, const Capsule& second) {
  return closest_points(first.a, first.b, second.a, second.b).distance - first.radius - second.radius;
}

}  // namespace tanglebin
