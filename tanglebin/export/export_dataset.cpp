#include "tanglebin/export/export_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/export/format.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tanglebin/runs/journal.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr const char* index_name = "export.json";

struct FormatName {
  ExportFormat format;
  const char* name;
};
constexpr std::array<FormatName, 5> format_names{{{ExportFormat::coco, "coco"},
                                                  {ExportFormat::numpy, "numpy"},
                                                  {ExportFormat::webdataset, "webdataset"},
                                                  {ExportFormat::hdf5, "hdf5"},
                                                  {ExportFormat::bop, "bop"}}};

Format functions_of(ExportFormat format, const Recipe& recipe) {
  switch (format) {
    case ExportFormat::coco:
      return coco_format(recipe);
    case ExportFormat::numpy:
      return numpy_format(recipe);
    case ExportFormat::webdataset:
      return webdataset_format();
    case ExportFormat::hdf5:
      return hdf5_format(recipe);
    case ExportFormat::bop:
      return bop_format(recipe);
  }
  throw std::invalid_argument("unknown format");
}

std::string digest_of(const Dataset& dataset) {
  if (const auto summary = read_dataset_summary(dataset.directory)) return summary->digest;
  throw InputError({(dataset.directory / summary_name).string(), 0, ""}, "missing",
                   "a dataset of which `tanglebin generate` has ended");
}

std::string names_sha256(const std::vector<CaseId>& cases) {
  Sha256 hash;
  for (const CaseId& id : cases) hash.add(name_of(id) + '\n');
  return hash.hex();
}

// All that the export's bytes depend on, but for libraries that compress.
Json index_of(const Dataset& dataset, const ExportRequest& request) {
  return {{"format", name_of(request.format)},    {"version", versions().at("tanglebin")},
          {"dataset_digest", digest_of(dataset)}, {"recipe_sha256", dataset.recipe_sha256},
          {"cases", request.wanted.size()},       {"cases_sha256", names_sha256(request.wanted)}};
}

// Expects a directory that is missing or empty, or has an export or other shards' journals.
void expect_export_or_empty(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  const std::set<fs::path> foreign = besides_journals(directory);
  if (foreign.empty() || fs::exists(directory / index_name)) return;
  throw InputError({directory.string(), 0, ""}, foreign.begin()->filename().string(),
                   "an export or an empty directory");
}

std::vector<ExportUnit> units_of(const std::vector<CaseId>& cases, std::size_t size) {
  std::vector<ExportUnit> units;
  for (std::size_t first = 0; first < cases.size(); first += size) {
    const std::size_t end = std::min(first + size, cases.size());
    units.push_back({units.size() + 1,
                     {cases.begin() + static_cast<std::ptrdiff_t>(first),
                      cases.begin() + static_cast<std::ptrdiff_t>(end)}});
  }
  return units;
}

std::size_t cases_in(const std::vector<ExportUnit>& units) {
  std::size_t cases = 0;
  for (const ExportUnit& unit : units) cases += unit.cases.size();
  return cases;
}

/// One run of export_dataset().
class Exporting {
public:
  Exporting(const Dataset& dataset, const ExportRequest& request, const RunObserver& observer)
      : request_(request),
        observer_(observer),
        index_(index_of(dataset, request)),
        format_(functions_of(request.format, dataset.recipe)),
        reader_(dataset),
        all_(units_of(request.wanted, format_.cases_per_unit)) {}

  ExportSummary run() {
    expect_export_or_empty(request_.directory);
    make_directories(request_.directory);
    {
      const Journal journal(request_.directory, request_.shard ? name_of(*request_.shard) : "");
      claim(journal.staging());
      find_missing();
      if (!missing_.empty()) write_index(false, journal.staging());
      write_missing(journal.staging());
    }
    summary_.is_complete = complete();
    return std::move(summary_);
  }

private:
  fs::path index_file() const { return request_.directory / index_name; }

  // Writes the index if there is none, or expects it to be of the same export.
  void claim(const fs::path& staging) const {
    const DirectoryLock lock(request_.directory);
    if (!fs::exists(index_file())) write_index_file(false, staging);
    const JsonRecord found = read_index();
    for (const auto& [key, value] : index_.items()) {
      if (!found.has(key)) found.fail(key, "nothing", json_text(value));
      if (found.json().at(key) == value) continue;
      found.fail(key, json_text(found.json().at(key)),
                 json_text(value) + "; the directory has another export");
    }
  }

  JsonRecord read_index() const { return {read_file(index_file()), index_file().string(), 0}; }

  void write_index(bool is_complete, const fs::path& staging) const {
    const DirectoryLock lock(request_.directory);
    write_index_file(is_complete, staging);
  }

  void write_index_file(bool is_complete, const fs::path& staging) const {
    Json index = index_;
    index["complete"] = is_complete;
    write_staged(index_file(), json_text(index) + '\n', staging);
    sync_directory(request_.directory);
  }

  bool are_there(const std::vector<std::string>& files) const {
    return std::ranges::all_of(
        files, [this](const std::string& file) { return fs::exists(request_.directory / file); });
  }

  bool is_done(const ExportUnit& unit) const { return are_there(format_.files_of(unit)); }

  void find_missing() {
    const std::vector<ExportUnit> own = request_.shard ? part_of(*request_.shard, all_) : all_;
    missing_ = own;
    std::erase_if(missing_, [this](const ExportUnit& unit) { return is_done(unit); });
    summary_.progress.wanted = cases_in(own);
    summary_.progress.found = summary_.progress.wanted - cases_in(missing_);
  }

  void write_missing(const fs::path& staging) {
    std::vector<CaseId> to_do;
    to_do.reserve(cases_in(missing_));
    for (const ExportUnit& unit : missing_) to_do.insert(to_do.end(), unit.cases.begin(), unit.cases.end());
    observer_.begun(to_do);
    const Task write = [&](std::size_t task) {
      ExportFiles files(request_.directory, staging);
      format_.write(missing_[task], reader_, files);
      return std::string();
    };
    run_in_workers(request_.jobs, missing_.size(), write,
                   {.done = [this](const std::vector<TaskResult>& results) { record(results); },
                    .failed = [this](const TaskFailure& failure) { record(failure); },
                    .tick = [this] { observer_.progress(summary_.progress); },
                    .stopping = observer_.stopping},
                   limit());
  }

  TimeLimit limit() const {
    if (request_.case_limit == no_limit) return no_limit;
    return request_.case_limit * static_cast<TimeLimit::rep>(format_.cases_per_unit);
  }

  void record(const std::vector<TaskResult>& results) {
    for (const TaskResult& result : results) {
      const std::vector<CaseId>& cases = missing_[result.task].cases;
      for (const CaseId& id : cases) {
        ++summary_.progress.made;
        observer_.ended({id, result.seconds / static_cast<double>(cases.size()), 0, {}}, summary_.progress);
      }
    }
  }

  void record(const TaskFailure& failure) {
    for (const CaseId& id : missing_[failure.task].cases) {
      ++summary_.progress.failed;
      summary_.failed.push_back({id, failure.reason});
      observer_.ended({id, 0, 0, failure.reason}, summary_.progress);
    }
  }

  // Writes what is about all cases if they are all there and nobody has written it. Of several shards, the
  // last to end does so.
  bool complete() const {
    const DirectoryLock lock(request_.directory);
    const fs::path staging = request_.directory / ".assembling.unfinished";
    fs::remove_all(staging);  // of a run that was killed
    if (read_index().json().value("complete", false) && are_there(format_.common_files)) return true;
    const auto is_missing = [this](const ExportUnit& unit) { return !is_done(unit); };
    if (std::ranges::any_of(all_, is_missing)) return false;
    make_directories(staging);
    ExportFiles files(request_.directory, staging);
    format_.assemble(all_, files);
    write_index_file(true, staging);
    fs::remove_all(staging);
    return true;
  }

  const ExportRequest& request_;
  const RunObserver& observer_;
  Json index_;
  Format format_;
  SceneReader reader_;
  std::vector<ExportUnit> all_;      ///< of all shards
  std::vector<ExportUnit> missing_;  ///< of this one
  ExportSummary summary_;
};

}  // namespace

std::vector<ExportFormat> export_formats() {
  std::vector<ExportFormat> formats;
  formats.reserve(format_names.size());
  for (const auto& [format, name] : format_names) formats.push_back(format);
  return formats;
}

std::string name_of(ExportFormat format) {
  for (const FormatName& entry : format_names) {
    if (entry.format == format) return entry.name;
  }
  throw std::invalid_argument("unknown format");
}

ExportFormat export_format_named(const std::string& name) {
  std::vector<std::string> names;
  for (const FormatName& entry : format_names) {
    if (entry.name == name) return entry.format;
    names.emplace_back(entry.name);
  }
  throw InputError({"", 0, "format"}, excerpt(name), fmt::format("one of {}", fmt::join(names, ", ")));
}

ExportSummary export_dataset(const Dataset& dataset, const ExportRequest& request,
                             const RunObserver& observer) {
  validate_jobs(request.jobs);
  return Exporting(dataset, request, observer).run();
}

}  // namespace tanglebin
