#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/runs/shard.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {

/// What a dataset can be exported as (docs/export.md).
enum class ExportFormat { coco, numpy, webdataset, hdf5, bop };

std::vector<ExportFormat> export_formats();
std::string name_of(ExportFormat format);

/// The inverse of name_of(). Throws InputError for any other name.
ExportFormat export_format_named(const std::string& name);

/// What is to be exported, and where to.
struct ExportRequest {
  ExportFormat format;
  std::vector<CaseId> wanted;  ///< of the dataset's cases; of all shards
  std::filesystem::path directory;
  std::optional<Shard> shard{};  ///< if several runs work in the directory: which of them this is
  int jobs = 1;                  ///< worker processes
  TimeLimit case_limit = no_limit;
};

/// A case that was given up.
struct FailedExport {
  CaseId id;
  std::string reason;
};

/// The outcome of export_dataset().
struct ExportSummary {
  RunProgress progress;  ///< of this shard's cases
  std::vector<FailedExport> failed;
  bool is_complete = false;  ///< the whole export, of all shards

  bool was_stopped() const { return progress.found + progress.made + progress.failed < progress.wanted; }
};

/// Writes the wanted cases of a dataset in another format, in worker processes. The bytes depend only on
/// dataset, format and cases, and on the versions of Tanglebin and the libraries that compress. Cases that
/// are there are kept, so an interrupted run can be resumed, and shards may write to one directory at the
/// same time; the last to end writes what is about all cases. Returns early, with what is done, on SIGINT and
/// SIGTERM. Throws InputError if generating the dataset has not ended, if `directory` has other files or the
/// export of something else, and as SceneReader does; SystemError if another run of this shard is writing
/// there, or if a file cannot be written.
ExportSummary export_dataset(const Dataset& dataset, const ExportRequest& request,
                             const RunObserver& observer = {});

}  // namespace tanglebin
