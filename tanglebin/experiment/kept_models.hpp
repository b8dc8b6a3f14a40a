#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"

// What `experiment --keep` keeps of each run, below a results directory.
namespace tanglebin {

/// The files of a run, relative to the results directory: the labelled cloud, the tubes as a configuration,
/// and the tubes with their evidence: "models/axis/0.3/A10/plys/1.ply", …/tube_configurations/1.txt,
/// …/tubes/1.json.
std::vector<std::filesystem::path> files_of(const RunId& run);

/// Writes them, replacing older ones. Throws as write_file() does.
void keep_model(const std::filesystem::path& directory, const RunId& run, const PointCloud& cloud,
                const Model& model);

/// The kept models of a method, as an entry of the same name.
Entry entry_of_kept(const std::filesystem::path& directory, const std::string& method);

/// Whether a results directory has all of a run's files.
bool has_model(const std::filesystem::path& directory, const RunId& run);

}  // namespace tanglebin
