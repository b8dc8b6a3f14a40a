#include "tanglebin/dataset/fill_dataset.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Recipe& recipe) {
  std::ostringstream out;
  write_recipe(out, recipe);
  return out.str();
}

// Writes the directory's recipe, or expects it to be the same.
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
    if (summary_.progress.made + summary_.progress.failed > 0) summary_.dataset = fold_at_the_end();
    return std::move(summary_);
  }

private:
  void begin() {
    const DirectoryLock lock(request_.directory);
    claim(request_.directory, request_.recipe, journal_.staging());
    const std::vector<Journal> abandoned = abandoned_journals(request_.directory);
    Catalogue before(request_.directory, damage());
    for (const CaseId& id : to_replace()) before.drop(id);
    for (const CaseId& id : request_.wanted) {
      if (!before.has(id)) missing_.push_back(id);
    }
    summary_.progress.wanted = request_.wanted.size();
    summary_.progress.found = request_.wanted.size() - missing_.size();
    const std::optional<DatasetSummary> known = known_summary();
    const bool is_folded = known && std::ranges::includes(known->made_with, made_with()) &&
                           journal_.is_empty() && abandoned.empty() && !request_.repair &&
                           request_.failed.empty();
    summary_.dataset = is_folded ? *known : fold(abandoned, to_replace());
  }

  // The versions that this run adds to the dataset.
  std::set<Versions> made_with() const {
    return missing_.empty() ? std::set<Versions>{} : request_.made_with;
  }

  // A repair writes a damaged one again: everything but the versions follows from the manifest.
  std::optional<DatasetSummary> known_summary() const {
    try {
      return read_dataset_summary(request_.directory);
    } catch (const InputError&) {
      if (!request_.repair) throw;
      return std::nullopt;
    }
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
    const Task make_case = [&](std::size_t task) {
      const auto [record, times] = make_(missing_[task], writer);
      return journal_line(record, times);
    };
    observer_.begun(missing_);
    summary_.was_interrupted = !run_in_workers(request_.jobs, missing_.size(), make_case, workers);
  }

  // First waits for the files' names, then writes the journal's lines.
  void record(const std::vector<TaskResult>& results) {
    std::vector<std::string> lines;
    std::vector<CaseEvent> events;
    std::set<fs::path> folders;
    lines.reserve(results.size());
    events.reserve(results.size());
    for (const TaskResult& result : results) {
      const std::string line = result.text.substr(0, result.text.find(journal_separator));
      const CaseRecord made = case_record(line, "a worker", 0);
      for (const FileRecord& file : made.files) add_folders(file.path, folders);
      lines.push_back(result.text);
      events.push_back({made.id, result.seconds, made.rejections.size(), {}});
    }
    for (const fs::path& folder : folders) sync_directory(request_.directory / folder);
    journal_.append(lines);
    for (const CaseEvent& event : events) {
      ++summary_.progress.made;
      summary_.progress.rejected += event.rejected;
      observer_.ended(event, summary_.progress);
    }
  }

  // Adds the file's folder and, the first time, the folders above it: another worker may have made them and
  // not yet waited for the disk.
  void add_folders(const std::string& file, std::set<fs::path>& folders) {
    fs::path folder = fs::path(file).parent_path();
    folders.insert(folder);
    if (!known_folders_.insert(folder).second) return;
    while (!folder.empty()) {
      folder = folder.parent_path();
      folders.insert(folder);
    }
  }

  void record(const TaskFailure& failure) {
    const CaseId& id = missing_[failure.task];
    const std::uint64_t seed = attempt_seed(request_.recipe.seed, id.set, id.tubes, id.number, 1);
    summary_.failed.push_back({id, seed, failure.reason});
    journal_.append({to_json(summary_.failed.back())});
    ++summary_.progress.failed;
    observer_.ended({id, 0, 0, failure.reason}, summary_.progress);
  }

  // The error that ended the run is the one to report; the journal keeps what cannot be written now.
  void end_after_an_error() {
    try {
      fold_at_the_end();
    } catch (const std::exception&) {
      return;
    }
  }

  DatasetSummary fold_at_the_end() {
    const DirectoryLock lock(request_.directory);
    return fold(abandoned_journals(request_.directory), {});
  }

  // Moves the journals of this run and of interrupted runs to the manifest. The caller has the directory's
  // lock.
  DatasetSummary fold(const std::vector<Journal>& abandoned, const std::vector<CaseId>& to_drop) {
    std::vector<fs::path> journals{journal_.file()};
    for (const Journal& journal : abandoned) journals.push_back(journal.file());
    Catalogue all(request_.directory, damage(), journals);
    for (const CaseId& id : to_drop) all.drop(id);
    for (const FailedCase& failed : request_.failed) all.add(failed);
    std::set<Versions> versions = made_with();
    if (const auto known = known_summary()) {
      versions.insert(known->made_with.begin(), known->made_with.end());
    }
    DatasetSummary dataset = all.write(order_, versions, journal_.staging());
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
  std::set<fs::path> known_folders_;  ///< of which the names are on the disk
  FillSummary summary_;
};

}  // namespace

void expect_same_recipe(const fs::path& file, const Recipe& wanted) {
  if (const auto found = difference(read_recipe(file), wanted))
    throw InputError({file.string(), 0, ""}, "the directory belongs to another recipe: " + *found);
}

CaseWriter::CaseWriter(fs::path directory, fs::path staging)
    : directory_(std::move(directory)), staging_(std::move(staging)) {}

FileRecord CaseWriter::write(const std::string& path, std::string_view bytes) const {
  make_directories((directory_ / path).parent_path());
  expect_below(directory_, directory_ / path);
  write_staged(directory_ / path, bytes, staging_);
  return {path, bytes.size(), sha256(bytes)};
}

FillSummary fill_dataset(const FillRequest& request, const MakeCase& make, const RunObserver& observer) {
  make_directories(request.directory);
  return Filling(request, make, observer).run();
}

}  // namespace tanglebin
