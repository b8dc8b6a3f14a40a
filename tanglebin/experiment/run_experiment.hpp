#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "tanglebin/dataset/workers.hpp"
#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// What a call of run_experiment() came to.
struct ExperimentSummary {
  std::size_t wanted = 0;  ///< cases asked for
  std::size_t found = 0;   ///< of these, already there
  std::size_t made = 0;    ///< of these, made now
  bool complete() const { return found + made == wanted; }
};

/// Models and scores the wanted cases of the dataset, which are there, with every method and ratio, in `jobs`
/// processes, and leaves in `directory` experiment.json, results.jsonl, times.jsonl and generation.jsonl
/// (docs/formats.md). Cases whose results are there already stay as they are, so a run that was stopped goes
/// on where it was, and more cases may be added. The bytes of results.jsonl depend on dataset, settings and
/// cases alone. Returns early, with what is done, on SIGINT and SIGTERM. `progress` is told how many of the
/// cases are done. Throws InputError where `directory` belongs to another experiment, to a dataset or to a
/// run that is under way, where a file of a case is missing or has changed, and where a file cannot be
/// written.
ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const Progress& progress);

}  // namespace tanglebin
