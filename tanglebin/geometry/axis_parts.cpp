#include "tanglebin/geometry/axis_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tanglebin {

std::vector<AxisPart> axis_parts(const Capsule& capsule, double length_max) {
  const Eigen::Vector3d way = capsule.b - capsule.a;
  const double length = way.norm();
  // Slightly less, so that rounding does not add a part to a length of whole parts.
  const int number = static_cast<int>(std::min(std::ceil(length / length_max - 1e-6), 1000.0));
  std::vector<AxisPart> parts;
  parts.reserve(static_cast<std::size_t>(number));
  for (int part = 0; part < number; ++part)
    parts.push_back({capsule.a + (part + 0.5) / number * way, length / number});
  return parts;
}

}  // namespace tanglebin
