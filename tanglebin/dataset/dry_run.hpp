#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {

/// What the cases of a set will take, estimated from a few of them.
struct SetEstimate {
  std::string set;
  std::size_t cases = 0;
  double seconds = 0;  ///< of one process, without waiting for the disk
  double bytes = 0;    ///< of the cases' files
};

/// A case made in memory.
struct MadeScene {
  Recipe recipe;  ///< resolved
  SimulatedScene scene;
};

struct DryRun {
  std::vector<SetEstimate> sets;      ///< in the recipe's order
  std::vector<std::string> warnings;  ///< a clause each, which begins with the place in the recipe or a case
  std::optional<MadeScene> first;     ///< the first of the cases, if it has a valid scene
};

/// How long dry_run() tries to make one case. The paper's take less than a second.
inline constexpr std::chrono::seconds default_patience{60};

/// Makes the first of the wanted cases (at least one) with the fewest, a middle and the largest number of
/// tubes of each set, and writes nothing. What the other cases take is interpolated between these. Warnings
/// are the doubts() about their recipes, cases without a valid scene, or without one after `patience`, and
/// scanners that see no tube. Throws InputError if a file of a case cannot be made, as generate_dataset()
/// does.
DryRun dry_run(const Recipe& recipe, const std::vector<CaseId>& wanted,
               std::chrono::steady_clock::duration patience = default_patience);

}  // namespace tanglebin
