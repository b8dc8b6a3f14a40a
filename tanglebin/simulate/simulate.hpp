#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// An attempt at a case that gave no valid scene.
struct Rejection {
  std::uint64_t seed;
  double simulated;  ///< s
  std::string fault;
};

/// Wall-clock seconds that the stages took, all attempts together.
struct StageTimes {
  double generate = 0.0;  ///< drawing and spawning the tubes
  double settle = 0.0;
  double scan = 0.0;
  double write = 0.0;  ///< the files; simulate() leaves it 0
};

/// A valid scene: tubes at rest in the bin, and what the scanners see of them.
struct Scene {
  std::vector<Tube> tubes;
  Scan scan;                        ///< by the recipe's first scanner
  std::vector<Scan> further_scans;  ///< by its further scanners
  std::uint64_t seed;               ///< of the attempt that made it
  double simulated;                 ///< s, of that attempt
  double largest_overlap;           ///< m
  std::vector<Rejection> rejections;
  StageTimes times;
};

/// Makes the scene of a case of a valid recipe without random numbers (resolve()): draws tubes, drops them,
/// scans them, and draws again while the heap is not valid (settle.hpp). The scene follows from (recipe seed,
/// set, number of tubes, case number, attempt) alone. The tubes' numbers are whole nanometres (quaternions:
/// billionths), so that the text format holds the scene exactly. Throws InputError when recipe.attempts have
/// failed, with what they failed by.
Scene simulate(const Recipe& recipe, const CaseId& id);

}  // namespace tanglebin
