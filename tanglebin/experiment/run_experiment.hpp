#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// A case that could not be modelled.
struct FailedModel {
  CaseId id;
  std::string reason;
};

/// The outcome of run_experiment().
struct ExperimentSummary {
  RunProgress progress;  ///< a case counts as made when all of its runs are
  std::vector<FailedModel> failed;

  bool is_complete() const { return progress.found + progress.made == progress.wanted; }
  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Models and scores the wanted cases, which the dataset must have, with every method and ratio in `jobs`
/// processes. Writes experiment.json, results.jsonl, times.jsonl and generation.jsonl (docs/formats.md) to
/// `directory`. Existing results are kept, so an interrupted run can be resumed and cases can be added. The
/// bytes of results.jsonl depend only on dataset, settings and cases. A case that crashes its worker twice is
/// recorded as failed, and the run goes on. Returns early, with what is done, on SIGINT and SIGTERM. Throws
/// InputError if `directory` belongs to another experiment, to a dataset or to a run in progress, if a file
/// of a case is missing or has changed, and if a file cannot be written.
ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const RunObserver& observer = {});

}  // namespace tanglebin
