#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// An attempt that gave no valid scene.
struct Rejection {
  std::uint64_t seed;
  double simulated;  ///< s
  std::string fault;
};

/// Wall-clock time of each stage, s, summed over all attempts.
struct StageTimes {
  double generate = 0.0;  ///< drawing and spawning the tubes
  double settle = 0.0;
  double scan = 0.0;
  double write = 0.0;  ///< writing the files; simulate() leaves it 0
};

/// A valid scene: tubes at rest in the bin, and the scans of them.
struct SimulatedScene {
  std::vector<Tube> tubes;
  Scan scan;                        ///< by the recipe's first scanner
  std::vector<Scan> further_scans;  ///< by its further scanners
  std::uint64_t seed;               ///< of the successful attempt
  double simulated;                 ///< s, of that attempt
  double largest_overlap;           ///< m
  std::vector<Rejection> rejections;
  StageTimes times;
};

/// Simulates a case of a valid recipe without random numbers (resolve()): draws tubes, drops and scans them,
/// and draws again while the heap is invalid (settle.hpp). The scene depends only on (recipe seed, set,
/// number of tubes, case number, attempt). The tubes' numbers are whole nanometres (quaternions: billionths),
/// so the text format stores the scene exactly. Throws InputError with the reasons after recipe.attempts
/// failures, or after a quarter of them if a tube left the bin in each: more tubes than fit. Calls
/// `before_attempt` before each attempt, and `at_step` as settle() does; what they throw ends the simulation.
SimulatedScene simulate(
    const Recipe& recipe, const CaseId& id, const std::function<void()>& before_attempt = [] {},
    const std::function<void(double)>& at_step = [](double) {});

}  // namespace tanglebin
