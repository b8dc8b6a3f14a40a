#pragma once

#include <Eigen/Geometry>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {

/// Parameter t in [0, 1] of the point a + t (b − a) on the axis that is nearest to a box.
double nearest_on_axis(const Capsule& capsule, const Eigen::AlignedBox3d& box);

}  // namespace tanglebin
