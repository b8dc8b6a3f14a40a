#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>

namespace tanglebin::test {

/// Of a coarse grid, so that segments are often points, parallel, collinear or touch, and places are often as
/// near to one as to another.
inline Eigen::Vector3d any_point() {
  const auto coordinate = rc::gen::inRange(-3, 4);
  return Eigen::Vector3d(*coordinate, *coordinate, *coordinate) / 10;
}

}  // namespace tanglebin::test
