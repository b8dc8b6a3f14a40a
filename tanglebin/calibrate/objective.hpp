#pragma once

#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// What a calibration maximizes: the mean over scenes of a measure from 0 to 1 (docs/metrics.md).
enum class Objective {
  unmixed_recall,  ///< micro-recall without mixed points, which no parameters put right
  micro_recall,
  panoptic_quality,
  complete_tubes,  ///< the share of the true tubes that are complete
};

/// All of them, the default first.
std::vector<Objective> objectives();

/// "micro_recall", …. objective_named() is the inverse; it throws InputError for any other name.
std::string name_of(Objective objective);
Objective objective_named(const std::string& name);

/// The measure of one scene.
double value_of(Objective objective, const CaseData& data, const ModelScore& score);

}  // namespace tanglebin
