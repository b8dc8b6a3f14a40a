#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/calibrate/objective.hpp"
#include "tanglebin/calibrate/scene_scores.hpp"
#include "tanglebin/calibrate/tune.hpp"
#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/profile/profile.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// When to stop the search. An evaluation is one scene modelled with one set of parameters.
struct CalibrationBudget {
  std::size_t evaluations = 5000;
  /// Wall clock, of one call of calibrate() with all that it does, as far as that can be foreseen.
  std::optional<std::chrono::duration<double>> time{};
};

/// How to calibrate.
struct CalibrationSettings {
  ScoringSettings scoring{};
  int scenes = 40;  ///< to calibrate on; as many others to see what it is worth
  CalibrationBudget budget{};
  Parameters start{};  ///< where to start instead of the defaults
};

/// How far a calibration is.
struct CalibrationProgress {
  std::string step{};           ///< "looking for what matters", …
  std::size_t evaluations = 0;  ///< done, whether in this call or before
  std::size_t most = 0;         ///< with those to come: an estimate, mostly too large
  double before = 0;            ///< mean score of the start on the scenes to calibrate on; 0 if unknown
  double best = 0;              ///< the best mean so far
  /// Until the end, at most, at the pace of this call; nothing before its first evaluation.
  std::optional<std::chrono::duration<double>> left{};
};

/// Functions to call, in the calling process, as a calibration goes on.
struct CalibrationObserver {
  RunObserver scenes{};                                                           ///< of the simulation
  std::function<void(const CalibrationProgress&)> progress = [](const auto&) {};  ///< a few times a second
  std::function<void()> stopping = [] {};  ///< after the first SIGINT or SIGTERM
};

/// What came of a calibration.
struct Calibration {
  Profile profile;                           ///< with the parameters of the start if these are as good
  std::vector<Sensitivity> sensitivities{};  ///< of the first round; empty if the budget ended before
  std::size_t evaluations = 0;
  bool is_better = false;  ///< than the start, on the scenes that it was not calibrated on
};

/// Finds parameters of a method that fit the tubes, the bin and the scanner of a valid recipe
/// (docs/calibration.md). Scenes are simulated from the recipe with other seeds than its own. All that is
/// done is kept in `directory`, so the same call goes on after any interruption; without a budget in time,
/// the result depends only on recipe and settings. Returns nothing if SIGINT or SIGTERM ended it. Throws
/// InputError if no valid scene shows a tube, or if the directory belongs to another calibration, and as
/// generate_dataset() and model_tubes() do.
std::optional<Calibration> calibrate(const Recipe& recipe, const CalibrationSettings& settings,
                                     const std::filesystem::path& directory,
                                     const CalibrationObserver& observer = {});

}  // namespace tanglebin
