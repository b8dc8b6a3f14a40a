#pragma once

#include <filesystem>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/report/model_again.hpp"

namespace tanglebin {

/// Draws each method's examples() at ratio_to_show() of the results in `directory`: truth and labels, seen
/// from above. Writes pictures/ and pictures.jsonl (docs/formats.md). A command that fails
/// this time has no picture. Throws InputError as run_experiment() does.
void write_pictures(const std::filesystem::path& directory, const Dataset& dataset,
                    const ExperimentSettings& settings, ModelAgain& model_again);

}  // namespace tanglebin
