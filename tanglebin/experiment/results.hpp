#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/experiment/run_failure.hpp"

namespace tanglebin {

/// A line of results.jsonl.
struct RunResult {
  RunId run;
  std::string case_sha256;  ///< of the case that was modelled (run.hpp)
  double micro_recall;      ///< 0 if the run failed
  std::optional<RunFailure> failure;
  std::string json;
};

/// The lines for a run (docs/formats.md), without a line end.
std::string result_json(const RunId& run, const std::string& case_sha256, const Model& model,
                        const ModelScore& score);
std::string failure_json(const RunId& run, const std::string& case_sha256, const RunFailure& failure);
std::string times_json(const RunId& run, const Model& model, double seconds);

/// The journal line for a case: the lines above for each of its runs.
std::string journal_line(const std::vector<std::string>& lines);

/// The results of the finished runs.
struct FinishedRuns {
  std::map<RunId, RunResult> results;
  std::map<RunId, std::string> times;  ///< lines of times.jsonl

  /// True if all runs of a case are finished: scored, or failed in a way that would repeat itself.
  bool has(const CaseId& id, const ExperimentSettings& settings) const;

  /// Forgets the runs of cases that were another scene then. Throws InputError for a run of a case that the
  /// dataset does not have.
  void forget_changed_cases(const Dataset& dataset);
};

/// Reads the results, times and journal of a results directory. A truncated last line of the journal is
/// ignored. Throws InputError for any other line that cannot be read.
FinishedRuns finished_runs(const std::filesystem::path& directory);

/// Throws InputError if the directory belongs to another experiment or was written by another build of the
/// program, naming the difference, or to a dataset.
void expect_free(const std::filesystem::path& directory, const Dataset& dataset,
                 const ExperimentSettings& settings);

/// Writes experiment.json if the directory has none. Throws as expect_free() does.
void claim(const std::filesystem::path& directory, const Dataset& dataset,
           const ExperimentSettings& settings);

/// Writes experiment.json, results.jsonl, times.jsonl and generation.jsonl, with runs in order of method,
/// case and ratio.
void write_results(const std::filesystem::path& directory, const Dataset& dataset,
                   const ExperimentSettings& settings, const FinishedRuns& finished);

/// The lines of results.jsonl. Throws InputError for a line that cannot be read.
std::vector<RunResult> read_results(const std::filesystem::path& directory);

}  // namespace tanglebin
