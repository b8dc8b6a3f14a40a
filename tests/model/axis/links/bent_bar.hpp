#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"

namespace tanglebin::test {

inline constexpr double bar_radius = 0.006;  // m
inline constexpr double node_step = 0.004;   // m

/// Straight pieces of 60 mm with round bends of 3 radii between them, in a plane.
inline CentrePath bent_bar(double first_bend, double second_bend) {
  CentrePath path{Eigen::Vector3d::Zero()};
  double heading = 0;
  const auto go = [&](double length, double turn) {
    const int steps = static_cast<int>(std::lround(length / node_step));
    for (int i = 0; i < steps; ++i) {
      heading += turn / steps;
      path.push_back(path.back() + length / steps * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0));
    }
  };
  go(0.06, 0);
  go(3 * bar_radius * first_bend, first_bend);
  go(0.06, 0);
  go(3 * bar_radius * second_bend, second_bend);
  go(0.06, 0);
  return path;
}

inline CentrePath moved(const Eigen::Isometry3d& pose, CentrePath path) {
  for (Eigen::Vector3d& node : path) node = pose * node;
  return path;
}

/// Three bars with two bends of 100 degrees.
inline TubeShapes equal_bars() {
  const CentrePath bar = bent_bar(100 * degree, 100 * degree);
  return {{bar, bar, bar}, bar_radius};
}

}  // namespace tanglebin::test
