#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/runs/shard.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {

/// Throws InputError naming the first setting in which the recipe in a dataset's directory differs from
/// `wanted`.
void expect_same_recipe(const std::filesystem::path& directory, const Recipe& wanted);

/// Writes a case's files into a dataset's directory.
class CaseWriter {
public:
  CaseWriter(std::filesystem::path directory, std::filesystem::path staging);

  /// Writes the file, whole or not at all; `path` is relative to the dataset's directory. Returns its entry
  /// in the manifest. Throws InputError if it cannot be written.
  FileRecord write(const std::string& path, std::string_view bytes) const;

private:
  std::filesystem::path directory_;
  std::filesystem::path staging_;
};

/// A case whose files are written.
struct MadeCase {
  CaseRecord record;
  TimesRecord times;
};

/// Makes a case in a worker process. May throw as a Task does (workers.hpp).
using MakeCase = std::function<MadeCase(const CaseId& id, const CaseWriter& writer)>;

/// The wall-clock time that a case may take; beyond it, it fails and is for a later run to try again.
inline constexpr std::chrono::seconds default_case_limit{600};

/// What a run is to put into a dataset's directory.
struct FillRequest {
  Recipe recipe;
  std::vector<CaseId> wanted;
  std::filesystem::path directory;
  std::optional<Shard> shard{};  ///< if several runs fill the directory: which of them this is
  int jobs = 1;                  ///< worker processes
  TimeLimit case_limit = default_case_limit;
  std::set<Versions> made_with{};    ///< for dataset.json, if any cases are made
  std::vector<FailedCase> failed{};  ///< cases known to have failed elsewhere
  /// If set: finished cases to make again; damaged lines of the dataset are dropped. No other run may be in
  /// progress.
  std::optional<std::vector<CaseId>> repair{};
};

/// The outcome of a run.
struct FillSummary {
  RunProgress progress;
  std::vector<FailedCase> failed;  ///< of the cases asked for
  /// Of the whole directory; nullopt if other runs are to complete it.
  std::optional<DatasetSummary> dataset;
  bool was_interrupted = false;  ///< by SIGINT or SIGTERM, even if no case was left to make

  bool is_complete() const { return progress.found + progress.made == progress.wanted; }
  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Throws InputError unless the directory can be made, is empty or has a dataset of this recipe. Makes
/// nothing.
void expect_fillable(const std::filesystem::path& directory, const Recipe& recipe);

/// Makes the wanted cases that are missing in the directory, in worker processes, and writes recipe.toml,
/// manifest.jsonl, times.jsonl, failed.jsonl and dataset.json (docs/formats.md). Before the observer hears of
/// a case, its files and its line in the run's journal are on the disk: whatever ends the run, the next one
/// goes on from there. Shards may fill a directory at the same time. The last run to end there moves the
/// lines of all journals to the manifest; a shard leaves that to the others until all of them have been
/// there. Returns early on SIGINT and SIGTERM. Throws InputError if the directory has files but is no
/// dataset, belongs to another recipe or to a run of the same shard, if a file cannot be read or written, and
/// if making a case throws it.
FillSummary fill_dataset(const FillRequest& request, const MakeCase& make, const RunObserver& observer);

}  // namespace tanglebin
