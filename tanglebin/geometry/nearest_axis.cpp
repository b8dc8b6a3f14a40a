#include "tanglebin/geometry/nearest_axis.hpp"

#include <algorithm>
#include <cmath>

namespace tanglebin {

using Eigen::Vector3d;

NearestAxis::NearestAxis(const std::vector<Capsule>& capsules) {
  axes_.reserve(capsules.size());
  for (const Capsule& capsule : capsules) {
    const Vector3d way = capsule.b - capsule.a;
    axes_.push_back({capsule.a, way, way.squaredNorm(), capsule.a + way / 2, way.norm() / 2});
  }
}

Foot NearestAxis::foot_of(const Vector3d& point) {
  const auto foot_on = [&](std::size_t i) -> Foot {
    const Axis& axis = axes_[i];
    const double t =
        axis.square > 0 ? std::clamp((point - axis.start).dot(axis.way) / axis.square, 0.0, 1.0) : 0;
    return {i, t, point - (axis.start + t * axis.way)};
  };
  constexpr double rounding = 1 + 1e-9;
  Foot nearest = foot_on(last_);
  double least = nearest.way.squaredNorm();
  double distance = std::sqrt(least);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    // All of an axis is within half its length of its middle.
    const double reach = rounding * (axes_[i].half_length + distance);
    if (i == last_ || (point - axes_[i].middle).squaredNorm() > reach * reach) continue;
    const Foot foot = foot_on(i);
    const double square = foot.way.squaredNorm();
    if (square > least || (square == least && i > nearest.capsule)) continue;
    nearest = foot;
    least = square;
    distance = std::sqrt(least);
  }
  last_ = nearest.capsule;
  return nearest;
}

}  // namespace tanglebin
