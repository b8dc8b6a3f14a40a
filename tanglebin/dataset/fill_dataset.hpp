#pragma once

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

namespace tanglebin {

/// Throws InputError naming the first line in which the recipe in `file` is another one than `wanted`, as
/// write_recipe() writes it.
void expect_same_recipe(const std::filesystem::path& file, const Recipe& wanted);

/// Puts files of a case into a dataset's directory.
class CaseWriter {
public:
  CaseWriter(std::filesystem::path directory, std::filesystem::path staging);

  /// Writes the file, whole or not at all; `path` is relative to the dataset's directory. Returns what the
  /// manifest is to have of it. Throws InputError where it cannot be written.
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

/// Makes a case, in a worker process. May throw as a Task does (workers.hpp).
using MakeCase = std::function<MadeCase(const CaseId& id, const CaseWriter& writer)>;

/// What is to be in a dataset's directory when a run ends.
struct FillRequest {
  Recipe recipe;
  std::vector<CaseId> wanted;
  std::filesystem::path directory;
  std::string name{};                ///< of the run: empty, or that of its shard
  int jobs = 1;                      ///< worker processes
  std::set<Versions> made_with{};    ///< what dataset.json is to have where cases are made
  std::vector<FailedCase> failed{};  ///< cases that are known to have failed elsewhere
  /// Where it is set: cases to make again though they are there, and what cannot be read of the dataset is
  /// dropped.
  std::optional<std::vector<CaseId>> repair{};
};

/// What a run came to.
struct FillSummary {
  RunProgress progress;
  std::vector<FailedCase> failed;  ///< of the cases asked for
  DatasetSummary dataset;          ///< all that the directory has now
  bool was_interrupted = false;    ///< by SIGINT or SIGTERM, even if no case was left to make

  bool is_complete() const { return progress.found + progress.made == progress.wanted; }
  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Makes the wanted cases that are missing in the directory, in worker processes, and with them recipe.toml,
/// manifest.jsonl, times.jsonl, failed.jsonl and dataset.json (docs/formats.md). A case that is made is on
/// the disk with its line in the run's journal before the observer hears of it, so whatever ends the run, the
/// next one goes on from there. Runs of different names may fill a directory at the same time. Returns early,
/// with what is done, on SIGINT and SIGTERM. Throws InputError where the directory belongs to another recipe
/// or to a run of the same name that is under way, where a file cannot be read or written, and where making a
/// case throws it.
FillSummary fill_dataset(const FillRequest& request, const MakeCase& make, const RunObserver& observer);

}  // namespace tanglebin
