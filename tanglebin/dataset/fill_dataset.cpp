#include "tanglebin/dataset/fill_dataset.hpp"

#include <fmt/core.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/file_lock.hpp"
#include "tanglebin/dataset/finished_cases.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/safe_file.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// For the moments in which a run reads or writes what runs of other names read or write, too.
class DirectoryLock {
public:
  explicit DirectoryLock(const fs::path& directory) : file_(directory / ".lock"), lock_(take(file_)) {}
  ~DirectoryLock() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  static FileLock take(const fs::path& file) {
    constexpr std::chrono::minutes patience{5};
    if (std::optional<FileLock> lock = FileLock::take(file, patience)) return std::move(*lock);
    throw InputError({file.string(), 0, ""}, "another run has kept it locked for minutes");
  }

  fs::path file_;
  FileLock lock_;
};

std::string text_of(const Recipe& recipe) {
  std::ostringstream out;
  write_recipe(out, recipe);
  return out.str();
}

// The directory's recipe is written once; another one is not let in.
void claim(const fs::path& directory, const Recipe& recipe, const fs::path& staging) {
  const fs::path file = directory / "recipe.toml";
  if (fs::exists(file)) {
    expect_same_recipe(file, recipe);
    return;
  }
  write_staged(file, text_of(recipe), staging);
  sync_directory(directory);
}

/// One run of fill_dataset().
class Filling {
public:
  Filling(const FillRequest& request, const MakeCase& make, const RunObserver& observer)
      : request_(request),
        make_(make),
        observer_(observer),
        order_(cases(request.recipe)),
        journal_(request.directory, request.name) {}

  FillSummary run() {
    begin();
    try {
      make_missing();
    } catch (...) {
      end_after_an_error();
      throw;
    }
    if (summary_.progress.made + summary_.progress.failed > 0) summary_.dataset = fold();
    return std::move(summary_);
  }

private:
  void begin() {
    const DirectoryLock lock(request_.directory);
    claim(request_.directory, request_.recipe, journal_.staging());
    Catalogue before(request_.directory, damage());
    for (const CaseId& id : to_replace()) before.drop(id);
    for (const CaseId& id : request_.wanted) {
      if (!before.has(id)) missing_.push_back(id);
    }
    summary_.progress.wanted = request_.wanted.size();
    summary_.progress.found = request_.wanted.size() - missing_.size();
    const std::optional<DatasetSummary> known = read_dataset_summary(request_.directory);
    const bool is_folded = known && !before.has_journaled() && !request_.repair && request_.failed.empty();
    summary_.dataset = is_folded ? *known : fold_locked(to_replace());
  }

  std::vector<CaseId> to_replace() const { return request_.repair.value_or(std::vector<CaseId>{}); }

  Catalogue::Damage damage() const {
    return request_.repair ? Catalogue::Damage::is_passed_over : Catalogue::Damage::is_error;
  }

  void make_missing() {
    const CaseWriter writer(request_.directory, journal_.staging());
    const WorkersObserver workers{
        .done = [this](const std::vector<TaskResult>& results) { record(results); },
        .failed = [this](const TaskFailure& failure) { record(failure); },
        .tick = [this] { observer_.progress(summary_.progress); },
    };
    run_in_workers(
        request_.jobs, missing_.size(),
        [&](std::size_t task) {
          const auto [record, times] = make_(missing_[task], writer);
          return journal_line(record, times);
        },
        workers);
  }

  // Names first, then the lines that say that they are there.
  void record(const std::vector<TaskResult>& results) {
    std::vector<std::string> lines;
    std::vector<CaseEvent> events;
    std::set<fs::path> directories;
    lines.reserve(results.size());
    events.reserve(results.size());
    for (const TaskResult& result : results) {
      const std::string line = result.text.substr(0, result.text.find(journal_separator));
      const CaseRecord made = case_record(line, "a worker", 0);
      for (const FileRecord& file : made.files) {
        directories.insert((request_.directory / file.path).parent_path());
      }
      lines.push_back(result.text);
      events.push_back({made.id, result.seconds, made.rejections.size(), {}});
    }
    for (const fs::path& directory : directories) sync_directory(directory);
    journal_.append(lines);
    for (const CaseEvent& event : events) {
      ++summary_.progress.made;
      summary_.progress.rejected += event.rejected;
      observer_.ended(event, summary_.progress);
    }
  }

  void record(const TaskFailure& failure) {
    const CaseId& id = missing_[failure.task];
    if (failure.impossible && summary_.progress.found + summary_.progress.made == 0) {
      throw InputError({"", 0, fmt::format("{}/{}", folder_name(id.set, id.tubes), id.number)},
                       failure.reason);
    }
    const std::uint64_t seed = attempt_seed(request_.recipe.seed, id.set, id.tubes, id.number, 1);
    summary_.failed.push_back({id, seed, failure.reason});
    journal_.append({to_json(summary_.failed.back())});
    ++summary_.progress.failed;
    observer_.ended({id, 0, 0, failure.reason}, summary_.progress);
  }

  // What ended the run is the error to tell of; the journal keeps what cannot be written now.
  void end_after_an_error() {
    try {
      fold();
    } catch (const std::exception&) {
      return;
    }
  }

  DatasetSummary fold() {
    const DirectoryLock lock(request_.directory);
    return fold_locked({});
  }

  // Moves what this run and runs that were cut off have in their journals to the manifest.
  DatasetSummary fold_locked(const std::vector<CaseId>& to_drop) {
    const std::vector<Journal> abandoned = abandoned_journals(request_.directory);
    Catalogue all(request_.directory, damage());
    for (const CaseId& id : to_drop) all.drop(id);
    for (const FailedCase& failed : request_.failed) all.add(failed);
    std::set<Versions> made_with = request_.made_with;
    if (const auto known = read_dataset_summary(request_.directory)) {
      made_with.insert(known->made_with.begin(), known->made_with.end());
    }
    DatasetSummary dataset = all.write(order_, made_with, journal_.staging());
    journal_.clear();
    for (const Journal& journal : abandoned) journal.clear();
    return dataset;
  }

  const FillRequest& request_;
  const MakeCase& make_;
  const RunObserver& observer_;
  std::vector<CaseId> order_;
  Journal journal_;
  std::vector<CaseId> missing_;
  FillSummary summary_;
};

}  // namespace

void expect_same_recipe(const fs::path& file, const Recipe& wanted) {
  std::ifstream found_stream(file, std::ios::binary);
  if (!found_stream) throw InputError({file.string(), 0, ""}, "cannot be opened");
  std::istringstream wanted_stream(text_of(wanted));
  std::string found_line;
  std::string wanted_line;
  for (std::size_t number = 1;; ++number) {
    const bool more_found = static_cast<bool>(std::getline(found_stream, found_line));
    const bool more_wanted = static_cast<bool>(std::getline(wanted_stream, wanted_line));
    if (!more_found && !more_wanted) return;
    if (more_found && more_wanted && found_line == wanted_line) continue;
    throw InputError({file.string(), number, ""},
                     fmt::format("the directory belongs to another recipe: it has \"{}\", this one \"{}\"",
                                 more_found ? found_line : "", more_wanted ? wanted_line : ""));
  }
}

CaseWriter::CaseWriter(fs::path directory, fs::path staging)
    : directory_(std::move(directory)), staging_(std::move(staging)) {}

FileRecord CaseWriter::write(const std::string& path, std::string_view bytes) const {
  make_directories((directory_ / path).parent_path());
  write_staged(directory_ / path, bytes, staging_);
  return {path, bytes.size(), sha256(bytes)};
}

FillSummary fill_dataset(const FillRequest& request, const MakeCase& make, const RunObserver& observer) {
  make_directories(request.directory);
  return Filling(request, make, observer).run();
}

}  // namespace tanglebin
