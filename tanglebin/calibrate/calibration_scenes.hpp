#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/run_observer.hpp"

namespace tanglebin {

/// Scenes of a recipe that are none of its own cases.
struct CalibrationScenes {
  Dataset dataset;
  std::vector<CaseId> scenes;  ///< that show a tube, of all sets and numbers of tubes in mixed order
};

/// The recipe with which scenes for a part of a calibration, such as "training", are made: with a seed of its
/// own, and `count` cases spread over the sets and numbers of tubes.
Recipe recipe_of_part(Recipe recipe, const std::string& part, int count);

/// Simulates the scenes of a part below `directory`, or goes on with it. Nothing if SIGINT or SIGTERM stopped
/// it. Throws InputError if there is no valid scene, or none that shows a tube.
std::optional<CalibrationScenes> make_scenes(const Recipe& recipe, const std::string& part, int count,
                                             const std::filesystem::path& directory, int jobs,
                                             const RunObserver& observer);

}  // namespace tanglebin
