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

/// The lines of a run (docs/formats.md), without the line's end.
std::string result_json(const RunId& run, const Model& model, const ModelScore& score);
std::string times_json(const RunId& run, const Model& model, double seconds);

/// The journal's line for a case: result_json() and times_json() of each of its runs.
std::string journal_line(const std::vector<std::string>& lines);

/// What is known of the runs that are finished.
struct FinishedRuns {
  std::map<RunId, RunResult> results;
  std::map<RunId, std::string> times;  ///< lines of times.jsonl

  /// Whether all of a case's runs are.
  bool has(const CaseId& id, const ExperimentSettings& settings) const;
};

/// What results, times and journal of a results' directory say. A last line of the journal that was cut off
/// is passed over; throws InputError for any other that cannot be read.
FinishedRuns finished_runs(const std::filesystem::path& directory);

/// Writes experiment.json where the directory has none. Throws InputError where its experiment.json is that
/// of another experiment, naming the difference, or where it is a dataset's.
void claim(const std::filesystem::path& directory, const Dataset& dataset,
           const ExperimentSettings& settings);

/// Writes experiment.json, results.jsonl, times.jsonl and generation.jsonl, runs in order of method, case and
/// ratio.
void write_results(const std::filesystem::path& directory, const Dataset& dataset,
                   const ExperimentSettings& settings, const FinishedRuns& finished);

/// The lines of results.jsonl. Throws InputError for one that cannot be read.
std::vector<RunResult> read_results(const std::filesystem::path& directory);

}  // namespace tanglebin
