#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// A case that was given up.
struct FailedModel {
  CaseId id;
  std::string reason;
};

/// The outcome of run_experiment().
struct ExperimentSummary {
  RunProgress progress;  ///< a case counts as made when all of its runs are, even if some failed
  std::vector<FailedModel> failed;

  bool is_complete() const { return progress.found + progress.made == progress.wanted; }
  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Models and scores the wanted cases, which the dataset must have, as each scanner sees them, with every
/// method and ratio in `jobs` processes. Writes experiment.json, results.jsonl, times.jsonl, results.csv,
/// tubes.csv and generation.jsonl (docs/formats.md), and the models if they are to be kept, to `directory`.
/// Existing results are kept, so an interrupted run can be resumed and cases can be added; a case whose
/// models are to be kept, but are not there, is run again. The bytes of results.jsonl depend only on dataset,
/// settings and cases, if commands give the same each time. A run that cannot be modelled or scored has a
/// line with the reason. So have all runs of a case that crashes its worker twice; the next call tries such a
/// case again, and also a case whose files have changed since. Returns early, with what is done, on SIGINT
/// and SIGTERM. Throws InputError if `directory` belongs to another experiment, to another build of the
/// program or to a dataset, if it has results of a case that the dataset lacks, and if a file of a case is
/// missing or not as the manifest says; SystemError if another run is writing there, and if a file cannot be
/// written.
ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const RunObserver& observer = {});

}  // namespace tanglebin
