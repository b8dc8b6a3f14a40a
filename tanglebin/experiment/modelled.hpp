#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// What an entry made of a case.
struct Modelled {
  Model model;
  bool has_tubes = true;                       ///< false if it gave labels only
  std::optional<double> seconds{};             ///< wall clock, modelling alone; none if the labels existed
  std::optional<std::string> labels_sha256{};  ///< of the files of labels that existed
};

/// Models a run's case by an entry. Of a command or of labels that exist, Model::filtered are the points that
/// the built-in methods with default settings are scored on; if there are tubes but no labels, the labels are
/// those of the nearest tubes, as by the built-in methods. `scratch` is a directory for a command's files.
/// Throws InputError if the entry cannot model the case.
Modelled model_by(const Entry& entry, const KnownScene& known, const CaseData& data, const RunId& run,
                  const ExperimentSettings& settings, const std::filesystem::path& scratch);

/// Throws InputError unless there is the directory for each of the ratios.
void expect_there(const LabelsDirectory& directory, const std::vector<double>& ratios);

/// The checksum of a run's files. Labels are in A10/plys/1.ply, A10/pcds/1.pcd, A10/labels/1.npy or
/// A10/labels/1.txt, tubes in A10/tube_configurations/1.txt, as in a dataset; of a scanner with a name in
/// A10/left/plys/1.ply, …. Empty if there are none.
std::string labels_sha256(const LabelsDirectory& directory, const RunId& run);

}  // namespace tanglebin
