#include "tanglebin/geometry/capsule_box.hpp"

namespace tanglebin {

// The distance of a point from a box is convex along a segment, so a ternary search finds its minimum.
double nearest_on_axis(const Capsule& capsule, const Eigen::AlignedBox3d& box) {
  const auto at = [&](double t) { return box.exteriorDistance(capsule.a + t * (capsule.b - capsule.a)); };
  double low = 0;
  double high = 1;
  while (high - low > 1e-9) {
    const double left = low + (high - low) / 3;
    const double right = high - (high - low) / 3;
    if (at(left) <= at(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return low;
}

}  // namespace tanglebin
