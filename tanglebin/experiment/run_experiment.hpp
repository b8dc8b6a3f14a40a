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

/// What a call of run_experiment() came to.
struct ExperimentSummary {
  RunProgress progress;  ///< a case is made when all of its runs are
  std::vector<FailedModel> failed;

  bool is_complete() const { return progress.found + progress.made == progress.wanted; }
  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Models and scores the wanted cases of the dataset, which are there, with every method and ratio, in `jobs`
/// processes, and leaves in `directory` experiment.json, results.jsonl, times.jsonl and generation.jsonl
/// (docs/formats.md). Cases whose results are there already stay as they are, so a run that was stopped goes
/// on where it was, and more cases may be added. The bytes of results.jsonl depend on dataset, settings and
/// cases alone. A case that ends its worker twice is given up, and the others go on. Returns early, with what
/// is done, on SIGINT and SIGTERM. Throws InputError where `directory` belongs to another experiment, to a
/// dataset or to a run that is under way, where a file of a case is missing or has changed, and where a file
/// cannot be written.
ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const RunObserver& observer = {});

}  // namespace tanglebin
