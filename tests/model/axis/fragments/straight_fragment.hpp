#pragma once

#include <Eigen/Core>

#include "tanglebin/model/axis/fragments/fragments.hpp"

namespace tanglebin::test {

/// A straight piece of a tube (m), as it would be found.
inline Fragment straight_fragment(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d direction = (to - from).normalized();
  return {.points = {},
          .nodes = {from, to},
          .parents = {0, 0},
          .ends = {{0, from, -direction}, {1, to, direction}},
          .length = (to - from).norm()};
}

}  // namespace tanglebin::test
