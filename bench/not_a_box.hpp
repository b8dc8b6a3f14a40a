#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {

/// Walls that lean outwards by 2 mm from the floor to the rim, and bulge by 2 mm in their middle.
inline void lean(PointCloud& cloud, const Bin& bin) {
  constexpr double near = 0.004;
  constexpr double most = 0.002;
  constexpr double bulge = 0.002;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != bin_label) continue;
    Eigen::Vector3f& point = cloud.points[i];
    const double up = std::clamp(point.z() / bin.height, 0.0, 1.0);
    const Eigen::Vector2d halves(bin.length / 2, bin.width / 2);
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(point[axis]) < halves[axis] - near) continue;
      const double along = point[1 - axis] / halves[1 - axis];
      const double moved = most * up + bulge * up * (1 - along * along);
      point[axis] += static_cast<float>(point[axis] > 0 ? moved : -moved);
    }
  }
}

}  // namespace tanglebin
