#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "tanglebin/generate/tube_spec.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin::test {

/// Of closed forms in double precision, relative, or m for tubes of some decimetres.
inline constexpr double rounding = 1e-12;

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

inline void connect(Tube& tube, std::size_t from, std::size_t to) {
  const int order = static_cast<int>(tube.edges.size()) + 1;
  tube.edges.push_back({from, to, order});
}

/// A tube of radius 12.5 mm and 0.5 kg whose centre line runs straight from point to point.
inline Tube tube_through(const std::vector<Eigen::Vector3d>& points) {
  Tube tube{.id = 1, .radius = 0.0125, .mass = 0.5, .nodes = {}, .edges = {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    tube.nodes.push_back({static_cast<int>(i) + 1, points[i]});
    if (i > 0) connect(tube, i - 1, i);
  }
  return tube;
}

/// Adds a branch to a tube: cylinders from one of its nodes from point to point.
inline void add_branch(Tube& tube, std::size_t from, const std::vector<Eigen::Vector3d>& points) {
  for (const Eigen::Vector3d& point : points) {
    tube.nodes.push_back({static_cast<int>(tube.nodes.size()) + 1, point});
    connect(tube, from, tube.nodes.size() - 1);
    from = tube.nodes.size() - 1;
  }
}

/// The paper's sets A and B (Section 6.1) and others like them: 5 to 10 cylinders, 0.5 m, bends from 0.
inline TubeSpec chain_spec(double bend_max_deg) {
  TubeSpec spec;
  spec.segments.front().bend_max = radians(bend_max_deg);
  return spec;
}

/// The published set C: two junctions, nodes 1 and 2, of three branches each.
inline TubeSpec tree_spec() {
  const auto segment = [](int from, int to, double length, int cylinders_min, int cylinders_max) {
    return SegmentSpec{{from, to, length}, cylinders_min, cylinders_max, 0.02, 0.0, radians(20)};
  };
  return {.radius = 0.0125,
          .mass = 0.75,
          .segments = {segment(1, 2, 0.30, 5, 10), segment(1, 3, 0.10, 2, 5), segment(1, 4, 0.10, 2, 5),
                       segment(2, 5, 0.10, 2, 5), segment(2, 6, 0.15, 2, 6)}};
}

}  // namespace tanglebin::test
