#pragma once

#include <filesystem>
#include <functional>

#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// Draws each method's examples() at ratio_to_show() of the results in `directory`: truth and labels, seen
/// from above. Writes pictures/ and pictures.jsonl (docs/formats.md). Models these runs again, which gives
/// the same models; a command that fails this time has no picture. Calls `at_run` before each of them;
/// what it throws ends the work. Throws InputError as run_experiment() does.
void write_pictures(
    const std::filesystem::path& directory, const Dataset& dataset, const ExperimentSettings& settings,
    const std::function<void()>& at_run = [] {});

}  // namespace tanglebin
