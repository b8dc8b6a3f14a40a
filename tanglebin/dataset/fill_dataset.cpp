#include "tanglebin/dataset/fill_dataset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Recipe& recipe) {
  return bytes_of([&](std::ostream& out) { write_recipe(out, recipe); });
}

// Other shards may begin at the same time: of theirs, journals may be here before the recipe. So the recipe
// is looked for at the end.
void expect_dataset_or_empty(const fs::path& directory) {
  const std::set<fs::path> foreign = besides_journals(directory);
  if (foreign.empty() || fs::exists(directory / recipe_name)) return;
  throw InputError({directory.string(), 0, ""},
                   foreign.contains(directory / "experiment.json") ? "the results of an experiment"
                                                                   : foreign.begin()->filename().string(),
                   "a dataset or an empty directory");
}

// Writes the directory's recipe, or expects it to be the same.
void claim(const fs::path& directory, const Recipe& recipe, const fs::path& staging) {
  const fs::path file = directory / recipe_name;
  if (!fs::exists(file)) {
    const DirectoryLock lock(directory);
    if (!fs::exists(file)) write_staged(file, text_of(recipe), staging);
    sync_directory(directory);
  }
  expect_same_recipe(directory, recipe);
}

/// One run of fill_dataset().
class Filling {
public:
  Filling(const FillRequest& request, const MakeCase& make, const RunObserver& observer)
      : request_(request),
        make_(make),
        observer_(observer),
        order_(cases(request.recipe)),
        journal_(std::in_place, request.directory, name()) {}

  FillSummary run() {
    begin();
    try {
      make_missing();
    } catch (...) {
      end_after_an_error();
      throw;
    }
    summary_.dataset = end();
    return std::move(summary_);
  }

private:
  std::string name() const { return request_.shard ? name_of(*request_.shard) : ""; }

  void begin() {
    claim(request_.directory, request_.recipe, journal_->staging());
    if (request_.repair) drop_broken_cases();
    const Catalogue before = cases_before();
    for (const CaseId& id : request_.wanted) {
      if (!before.has(id)) missing_.push_back(id);
    }
    summary_.progress.wanted = request_.wanted.size();
    summary_.progress.found = request_.wanted.size() - missing_.size();
    std::vector<std::string> lines{journal_header(request_.made_with)};
    for (const FailedCase& failed : request_.failed) {
      const bool is_known = before.has(failed.id) || before.failed().contains(failed.id);
      if (!is_known) lines.push_back(to_json(failed));
    }
    journal_->append(lines);
  }

  // The other shards make other cases, so their journals need not be read: each would read all of them.
  Catalogue cases_before() const {
    const DirectoryReadLock lock(request_.directory);
    std::vector<fs::path> journals = journals_in(request_.directory);
    std::erase_if(journals, [&](const fs::path& journal) {
      return journal != journal_->file() && is_of_the_shards(journal);
    });
    return {request_.directory, damage(), journals};
  }

  // Of this run's shard, or of another of as many.
  bool is_of_the_shards(const fs::path& journal) const {
    return request_.shard && journal.stem().string().ends_with(fmt::format("-of-{}", request_.shard->count));
  }

  // At once, so that they are not taken for finished if the run is interrupted.
  void drop_broken_cases() {
    const DirectoryLock lock(request_.directory);
    std::vector<fs::path> others = journals_in(request_.directory);
    std::erase(others, journal_->file());
    const std::vector<fs::path> in_use = journals_in_use(others);
    if (!in_use.empty()) {
      throw InputError({request_.directory.string(), 0, ""},
                       fmt::format("a run in progress ({})", in_use.front().filename().string()),
                       "none while a dataset is repaired");
    }
    write_manifest(journals_in(request_.directory), *request_.repair);
    for (const fs::path& journal : others) remove_journal(journal);
    journal_->clear();
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

  Catalogue::Damage damage() const {
    return request_.repair ? Catalogue::Damage::is_passed_over : Catalogue::Damage::is_error;
  }

  void make_missing() {
    const CaseWriter writer(request_.directory, journal_->staging());
    const WorkersObserver workers{
        .done = [this](const std::vector<TaskResult>& results) { record(results); },
        .failed = [this](const TaskFailure& failure) { record(failure); },
        .tick = [this] { observer_.progress(summary_.progress); },
        .stopping = observer_.stopping,
    };
    const Task make_case = [&](std::size_t task) {
      const auto [record, times] = make_(missing_[task], writer);
      return journal_line(record, times);
    };
    observer_.begun(missing_);
    summary_.was_interrupted =
        !run_in_workers(request_.jobs, missing_.size(), make_case, workers, request_.case_limit);
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
    journal_->append(lines);
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
    journal_->append({to_json(summary_.failed.back())});
    ++summary_.progress.failed;
    observer_.ended({id, 0, 0, failure.reason}, summary_.progress);
  }

  // The error that ended the run is the one to report; the journal keeps what cannot be written now.
  void end_after_an_error() {
    try {
      end();
    } catch (const std::exception&) {
      return;
    }
  }

  // The last run to end moves the lines of all journals to the manifest.
  std::optional<DatasetSummary> end() {
    const fs::path own = journal_->file();
    journal_.reset();
    const DirectoryLock lock(request_.directory);
    std::vector<fs::path> journals = journals_in(request_.directory);
    // Shards mostly end in order, so the next one is the most likely to be in progress.
    std::rotate(journals.begin(), std::ranges::upper_bound(journals, own), journals.end());
    if (are_shards_to_come(journals) || std::ranges::any_of(journals, is_locked)) return std::nullopt;
    return seal(journals);
  }

  // If shards run one after the other, the manifest is not to be written after each of them.
  bool are_shards_to_come(const std::vector<fs::path>& journals) const {
    if (!request_.shard || fs::exists(request_.directory / summary_name)) return false;
    const auto begun =
        std::ranges::count_if(journals, [this](const auto& path) { return is_of_the_shards(path); });
    return begun < request_.shard->count;
  }

  // The caller has the directory's lock, and no run has one of the journals.
  DatasetSummary seal(const std::vector<fs::path>& journals) const {
    const std::optional<DatasetSummary> known = known_summary();
    const bool is_sealed = known && std::ranges::none_of(journals, lists_cases);
    DatasetSummary dataset = is_sealed ? *known : write_manifest(journals, {});
    fs::remove_all(sealing());
    for (const fs::path& journal : journals) remove_journal(journal);
    return dataset;
  }

  // Writes the files that list the cases: all of the journals and the manifest but those to drop.
  DatasetSummary write_manifest(const std::vector<fs::path>& journals,
                                const std::vector<CaseId>& to_drop) const {
    Catalogue all(request_.directory, damage(), journals);
    for (const CaseId& id : to_drop) all.drop(id);
    std::set<Versions> versions = all.made_with();
    if (const auto known = known_summary()) {
      versions.insert(known->made_with.begin(), known->made_with.end());
    }
    make_directories(sealing());
    return all.write(order_, versions, sealing());
  }

  // The directory for the manifest while it is unfinished.
  fs::path sealing() const { return request_.directory / ".sealing.unfinished"; }

  const FillRequest& request_;
  const MakeCase& make_;
  const RunObserver& observer_;
  std::vector<CaseId> order_;
  std::optional<Journal> journal_;  ///< until the run ends
  std::vector<CaseId> missing_;
  std::set<fs::path> known_folders_;  ///< of which the names are on the disk
  FillSummary summary_;
};

}  // namespace

void expect_same_recipe(const fs::path& directory, const Recipe& wanted) {
  if (const auto found = difference(recipe_in(directory), wanted)) {
    throw InputError({(directory / recipe_name).string(), 0, ""},
                     "the directory belongs to another recipe: " + *found);
  }
}

CaseWriter::CaseWriter(fs::path directory, fs::path staging)
    : directory_(std::move(directory)), staging_(std::move(staging)) {}

FileRecord CaseWriter::write(const std::string& path, std::string_view bytes) const {
  expect_below(directory_, directory_ / path);
  make_directories((directory_ / path).parent_path());
  write_staged(directory_ / path, bytes, staging_);
  return {path, bytes.size(), sha256(bytes)};
}

void expect_fillable(const fs::path& directory, const Recipe& recipe) {
  expect_no_file_in_the_way(directory);
  if (!fs::exists(directory)) return;
  expect_dataset_or_empty(directory);
  if (fs::exists(directory / recipe_name)) expect_same_recipe(directory, recipe);
}

FillSummary fill_dataset(const FillRequest& request, const MakeCase& make, const RunObserver& observer) {
  validate_jobs(request.jobs);
  expect_fillable(request.directory, request.recipe);
  make_directories(request.directory);
  return Filling(request, make, observer).run();
}

}  // namespace tanglebin
