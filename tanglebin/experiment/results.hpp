#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/experiment/modelled.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/experiment/run_failure.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/runs/line_reader.hpp"

namespace tanglebin {

/// A line of results.jsonl.
struct RunResult {
  RunId run;
  std::string case_sha256;  ///< of the case that was modelled (run.hpp)
  double micro_recall = 0;  ///< 0 if the run failed
  std::optional<RunFailure> failure{};
  std::optional<std::string> labels_sha256{};  ///< of labels that existed
};

/// What the time of a run depends on besides the program.
struct Circumstances {
  std::string processor;  ///< its name, as /proc/cpuinfo has it; empty if unknown
  int jobs = 1;
  double load = 0;  ///< of the machine, average of the last minute
};
Circumstances circumstances(int jobs);

/// The lines for a run (docs/formats.md), without a line end.
std::string result_json(const RunId& run, const CaseRecord& scene, const Modelled& modelled,
                        const ModelScore& score);
std::string failure_json(const RunId& run, const CaseRecord& scene, const RunFailure& failure,
                         const std::optional<std::string>& labels_sha256 = {});
std::string times_json(const RunId& run, const Modelled& modelled, const Circumstances& circumstances);

/// The journal line for a case: the lines above for each of its runs.
std::string journal_line(const std::vector<std::string>& lines);

/// The runs of each case, in the order of the results' lines.
struct RunGrid {
  std::vector<std::string> methods;
  std::vector<double> ratios;
  std::vector<std::string> scanners = {""};

  std::size_t runs_of_a_method() const { return scanners.size() * ratios.size(); }
  std::size_t size() const { return methods.size() * runs_of_a_method(); }
  RunId run(std::size_t index, const CaseId& id) const;
  /// Throws InputError naming method, scanner or ratio if it has no such run.
  std::size_t index_of(const RunId& run) const;
};
RunGrid grid_of(const ExperimentSettings& settings, const Recipe& recipe);

/// The finished runs of results directories. Keeps only the places of their lines in memory, so it is small
/// even for many cases.
class FinishedRuns {
public:
  explicit FinishedRuns(RunGrid grid) : grid_(std::move(grid)) {}

  /// Adds the results, times and journals of a results directory; a later line of a run takes the place of an
  /// earlier one. Skips damaged lines of journals. Throws InputError for any other line that cannot be read
  /// or is of a run that the grid lacks.
  void add(const std::filesystem::path& directory);

  /// Adds the runs of another directory's. Throws InputError if both have the same run with other bytes.
  void merge(const std::filesystem::path& directory);

  /// True if all runs of a case are finished: scored, or failed in a way that would repeat itself.
  bool has(const CaseId& id) const;

  /// True if a run that is finished failed.
  bool is_failed(const RunId& run) const;

  /// Forgets the runs of cases that were another scene then, or had other labels. Throws InputError for a run
  /// of a case that the dataset does not have.
  void forget_changed(const Dataset& dataset, const ExperimentSettings& settings);

  /// Throws InputError naming `source` unless all cases are among these.
  void expect_cases_among(const std::vector<CaseId>& cases, const std::string& source) const;

  /// Writes results.jsonl, times.jsonl, results.csv and tubes.csv (docs/formats.md) with the runs in order of
  /// method, case, scanner and ratio. Returns the number of cases of which all runs are finished.
  std::size_t write(const std::filesystem::path& directory, const std::vector<CaseId>& order,
                    const std::filesystem::path& staging) const;

private:
  enum class State { missing, scored, failed, to_be_tried_again };
  struct Run {
    LinePlace result{};
    LinePlace times{};
    State state = State::missing;
    bool has_labels_sha256 = false;
  };
  struct Case {
    std::string sha256{};
    std::vector<Run> runs{};
  };

  void add_result(const std::string& line, const LinePlace& place);
  void add_times(const std::string& line, const LinePlace& place);
  void add_journal_line(const std::string& line, const LinePlace& place);
  bool has_other_labels(const Case& finished, const ExperimentSettings& settings) const;

  RunGrid grid_;
  std::vector<std::filesystem::path> files_{};
  std::map<CaseId, Case> cases_{};
};

/// Throws InputError if the directory belongs to another experiment or was written by another build of the
/// program, naming the difference, or to a dataset.
void expect_free(const std::filesystem::path& directory, const Dataset& dataset,
                 const ExperimentSettings& settings);

/// Writes experiment.json if the directory has none, by way of `staging`. Throws as expect_free() does.
void claim(const std::filesystem::path& directory, const Dataset& dataset, const ExperimentSettings& settings,
           const std::filesystem::path& staging);

/// Writes the files of FinishedRuns::write(), generation.jsonl and experiment.json.
void write_results(const std::filesystem::path& directory, const Dataset& dataset,
                   const ExperimentSettings& settings, const FinishedRuns& finished,
                   const std::filesystem::path& staging);

/// The name of the file that says what results follow from.
inline constexpr const char* experiment_name = "experiment.json";

/// Merges results of parts of one experiment into `directory`, which may already have some of the cases. The
/// result is as if one run had made them all, without pictures. Returns the number of cases of which all runs
/// are finished. Throws InputError if a part is of another experiment, of another build or of another
/// dataset, if two parts have different bytes for the same run, and as FinishedRuns do.
std::size_t merge_results(const std::vector<std::filesystem::path>& parts,
                          const std::filesystem::path& directory);

/// Calls `take` with every line of results.jsonl. Throws InputError for a line that cannot be read.
void for_each_result(const std::filesystem::path& directory,
                     const std::function<void(const RunResult&, const JsonRecord&)>& take);

}  // namespace tanglebin
