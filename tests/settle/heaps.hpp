#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/generate/generate.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/settle/spawn.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace tanglebin::test {

/// A straight tube from end to end.
inline Tube straight_tube(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int id = 1) {
  Tube tube = tube_through({from, to});
  tube.id = id;
  return tube;
}

/// Tubes 1, 2, … `count` of the paper's kind (A: bends up to 30°, B: 45°), not yet placed.
inline std::vector<Tube> drawn_tubes(Rng& rng, int count, double bend_max_deg) {
  std::vector<Tube> tubes;
  for (int id = 1; id <= count; ++id) tubes.push_back(draw_tube(rng, chain_spec(bend_max_deg), id));
  return tubes;
}

/// The same over a bin, ready to fall.
inline std::vector<Tube> spawned_tubes(std::uint64_t seed, int count, double bend_max_deg, const Bin& bin) {
  Rng rng(seed);
  std::vector<Tube> tubes = drawn_tubes(rng, count, bend_max_deg);
  spawn(rng, tubes, bin);
  return tubes;
}

/// How far the node has gone that has gone farthest, m.
inline double largest_motion(const std::vector<Tube>& before, const std::vector<Tube>& after) {
  double largest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < before[i].nodes.size(); ++j) {
      largest = std::max(largest, (after[i].nodes[j].position - before[i].nodes[j].position).norm());
    }
  }
  return largest;
}

}  // namespace tanglebin::test
