#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"

namespace tanglebin {

/// A line of results.jsonl.
struct RunResult {
  RunId run;
  double micro_recall;
  std::string json;
};

/// The lines for a run (docs/formats.md), without a line end.
std::string result_json(const RunId& run, const Model& model, const ModelScore& score);
std::string times_json(const RunId& run, const Model& model, double seconds);

/// The journal line for a case: result_json() and times_json() for each of its runs.
std::string journal_line(const std::vector<std::string>& lines);

/// The results of the finished runs.
struct FinishedRuns {
  std::map<RunId, RunResult> results;
  std::map<RunId, std::string> times;  ///< lines of times.jsonl

  /// True if all runs of a case are finished.
  bool has(const CaseId& id, const ExperimentSettings& settings) const;
};

/// Reads the results, times and journal of a results directory. A truncated last line of the journal is
/// ignored. Throws InputError for any other line that cannot be read.
FinishedRuns finished_runs(const std::filesystem::path& directory);

/// Writes experiment.json if the directory has none. Throws InputError if the directory belongs to another
/// experiment, naming the difference, or to a dataset.
void claim(const std::filesystem::path& directory, const Dataset& dataset,
           const ExperimentSettings& settings);

/// Writes experiment.json, results.jsonl, times.jsonl and generation.jsonl, with runs in order of method,
/// case and ratio.
void write_results(const std::filesystem::path& directory, const Dataset& dataset,
                   const ExperimentSettings& settings, const FinishedRuns& finished);

/// The lines of results.jsonl. Throws InputError for a line that cannot be read.
std::vector<RunResult> read_results(const std::filesystem::path& directory);

}  // namespace tanglebin
