#pragma once

#include <Eigen/Geometry>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How large a tube's surface is, with its flat ends as they are, m.
struct Extent {
  Eigen::AlignedBox3d box;  ///< the smallest around it, world frame
  double diameter = 0;      ///< the longest distance between two of its points
};

Extent extent_of(const Tube& tube);

}  // namespace tanglebin
