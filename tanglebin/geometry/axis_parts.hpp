#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {

/// A part of an axis, treated as a point.
struct AxisPart {
  Eigen::Vector3d middle;  ///< m
  double length;           ///< m
};

/// Cuts a capsule's axis into equal parts of at most this length, m, but at most a thousand, so that tubes in
/// millimetres by mistake do not take a thousand times as long. None of an axis of length 0.
std::vector<AxisPart> axis_parts(const Capsule& capsule, double length_max);

}  // namespace tanglebin
