#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// A bent chain of seven nearly level capsules through the bin, as a stand-in for a tube at rest.
inline Tube chain(Rng& rng, const Bin& bin, int id) {
  constexpr int cylinders = 7;
  constexpr double length = 0.5 / cylinders;
  Tube tube{.id = id, .radius = 0.0125, .mass = 0.5, .nodes = {}, .edges = {}};
  Eigen::Vector3d position(uniform_real(rng, -bin.length / 2, bin.length / 2),
                           uniform_real(rng, -bin.width / 2, bin.width / 2), uniform_real(rng, 0.02, 0.15));
  double heading = uniform_real(rng, 0, 2 * std::numbers::pi);
  tube.nodes.push_back({1, position});
  for (int i = 1; i <= cylinders; ++i) {
    heading += uniform_real(rng, -0.5, 0.5);
    const double climb = uniform_real(rng, -0.4, 0.4);
    const Eigen::Vector3d direction(std::cos(heading) * std::cos(climb), std::sin(heading) * std::cos(climb),
                                    std::sin(climb));
    Eigen::Vector3d next = position + length * direction;
    if (std::abs(next.x()) > bin.length / 2) next.x() = position.x() - length * direction.x();
    if (std::abs(next.y()) > bin.width / 2) next.y() = position.y() - length * direction.y();
    if (next.z() < tube.radius) next.z() = position.z() - length * direction.z();
    heading = std::atan2(next.y() - position.y(), next.x() - position.x());
    tube.nodes.push_back({i + 1, next});
    tube.edges.push_back({tube.nodes.size() - 2, tube.nodes.size() - 1, i});
    position = next;
  }
  return tube;
}

inline std::vector<Tube> pile(int tubes, const Bin& bin) {
  Rng rng(20);
  std::vector<Tube> pile;
  for (int id = 1; id <= tubes; ++id) pile.push_back(chain(rng, bin, id));
  return pile;
}

}  // namespace tanglebin
