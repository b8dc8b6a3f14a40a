#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/report/model_again.hpp"

namespace tanglebin {

/// A cloud to show in 3D, and why.
struct SceneToShow {
  SeenCase seen;
  std::vector<std::string> reasons;  ///< "worst of axis", "methods differ"
};

/// The `count` cases with the lowest micro-recall of each method, and the `count` in which the methods'
/// micro-recalls are farthest apart; the first of equals. Each case once, with all its reasons, in the order
/// of the first. Runs without a score do not count.
std::vector<SceneToShow> scenes_to_show(const ResultsSummary& results, const std::vector<Entry>& methods,
                                        std::size_t count);

/// A results directory has at most this many points of each scene in 3D.
inline constexpr std::size_t most_points_of_results = 25'000;

/// Writes scenes.jsonl (docs/formats.md): scenes_to_show() at ratio_to_show() of the results in `directory`,
/// with the points that the first method's filter left, and what every method found. Where ModelAgain
/// has no model, a method is left out. Throws InputError as run_experiment() does.
void write_scenes(const std::filesystem::path& directory, const Dataset& dataset,
                  const ExperimentSettings& settings, std::size_t count, ModelAgain& model_again);

}  // namespace tanglebin
