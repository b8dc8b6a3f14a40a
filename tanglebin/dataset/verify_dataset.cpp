#include "tanglebin/dataset/verify_dataset.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/dataset/verify_case.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

// "A10/3-20": neighbours in this list with consecutive numbers.
std::vector<std::string> ranges_of(const std::vector<CaseId>& ids) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, last = 0; first < ids.size(); first = ++last) {
    const auto& [set, tubes, number] = ids[first];
    while (last + 1 < ids.size() && ids[last + 1] == CaseId{set, tubes, ids[last].number + 1}) ++last;
    ranges.push_back(name_of(ids[first]));
    if (last > first) ranges.back() += fmt::format("-{}", ids[last].number);
  }
  return ranges;
}

// Not more of them than one can read.
std::string text_of_ranges(std::vector<std::string> ranges) {
  constexpr std::size_t most = 20;
  if (ranges.size() > most) {
    const std::size_t more = ranges.size() - most;
    ranges.resize(most);
    ranges.back() += fmt::format(" and {} more ranges", more);
  }
  return fmt::format("{}", fmt::join(ranges, ", "));
}

/// The verification of one dataset.
class Verification {
public:
  Verification(const fs::path& directory, Recipe recipe, const VerifySettings& settings,
               const RunObserver& observer)
      : directory_(directory),
        settings_(settings),
        observer_(observer),
        lock_(directory),
        journals_(journals_in(directory)),
        in_use_(journals_in_use(journals_)),
        catalogue_(directory, Catalogue::Damage::is_passed_over, journals_) {
    summary_.recipe = std::move(recipe);
    summary_.is_in_progress = !in_use_.empty();
    const std::vector<CaseId> all = cases(summary_.recipe);
    if (settings.wanted) expect_cases(summary_.recipe, *settings.wanted);
    for (const CaseId& id : all) state_.try_emplace(id);
    for (const CaseId& id : settings.wanted.value_or(all)) state_.at(id).is_wanted = true;
    read_manifest();
    read_times_and_failures();
    lock_.reset();
  }

  VerifySummary run() {
    read_journals();
    read_failures();
    check_summary();
    report_journals();
    find_unlisted_files();
    find_strays();
    check_cases();
    list_broken_cases();
    return std::move(summary_);
  }

private:
  struct State {
    bool is_wanted = false;
    bool is_there = false;
    bool is_broken = false;
  };

  void add(std::string where, std::string what) {
    summary_.faults.push_back({std::move(where), std::move(what)});
  }
  void add(const CaseId& id, std::string what) {
    state_[id].is_broken = true;
    add(name_of(id), std::move(what));
  }
  void note(std::string where, std::string what) {
    summary_.notes.push_back({std::move(where), std::move(what)});
  }

  // Without journals, the files that list the cases are complete.
  bool is_sealed() const { return journals_.empty(); }

  // Calls `take` with each line and its place. A line that it throws an InputError for is a fault.
  template <typename Take>
  void read_lines(const std::string& name, const Take& take) {
    std::uintmax_t whole = 0;
    for_each_whole_line(directory_ / name, [&](const std::string& line, std::size_t number) {
      const std::string where = fmt::format("{}:{}", name, number);
      try {
        take(line, where);
      } catch (const InputError& error) {
        add(where, complaint_of(error));
      }
      whole += line.size() + 1;
    });
    std::error_code none;
    if (const std::uintmax_t size = fs::file_size(directory_ / name, none); !none && size > whole) {
      add(name, fmt::format("{} bytes after the last line", size - whole));
    }
  }

  void read_manifest() {
    if (is_sealed() && !fs::exists(directory_ / manifest_name)) add(manifest_name, "missing");
    Digest digest;
    read_lines(manifest_name, [&](const std::string& line, const std::string& where) {
      const CaseRecord record = case_record(line, where, 0);
      digest.add(record);
      read_record(record, where);
    });
    summary_.digest = digest.hex();
  }

  // What they say of the cases is for the reader; here they must only be readable.
  void read_times_and_failures() {
    if (is_sealed() && !fs::exists(directory_ / times_name)) add(times_name, "missing");
    read_lines(times_name,
               [](const std::string& line, const std::string& where) { times_record(line, where, 0); });
    read_lines(failed_name,
               [](const std::string& line, const std::string& where) { failed_case(line, where, 0); });
  }

  void read_journals() {
    if (is_sealed()) return;
    Digest digest;  // of the manifest to come
    for (const CaseId& id : cases(summary_.recipe)) {
      if (!catalogue_.has(id)) continue;
      const CaseRecord record = catalogue_.record(id);
      digest.add(record);
      if (!state_[id].is_there) read_record(record, "a journal");
    }
    summary_.digest = digest.hex();
  }

  void read_record(const CaseRecord& record, const std::string& where) {
    ++summary_.cases;
    const auto found = state_.find(record.id);
    if (found == state_.end()) {
      add(where, fmt::format("{} is not a case of the recipe", name_of(record.id)));
      return;
    }
    if (found->second.is_there) add(record.id, fmt::format("is in the manifest twice ({})", where));
    found->second.is_there = true;
    for (const FileRecord& file : record.files) {
      listed_.insert(file.path);
      if (!file.path.ends_with(".txt")) continue;
      const auto [other, is_new] = scenes_.try_emplace(file.sha256, record.id);
      if (!is_new && other->second != record.id) {
        add(record.id, fmt::format("has the same tubes as {}", name_of(other->second)));
      }
    }
  }

  void read_failures() {
    for (const auto& [id, failed] : catalogue_.failed()) {
      const auto found = state_.find(id);
      if (found == state_.end() || found->second.is_there || !found->second.is_wanted) continue;
      std::string what = fmt::format("failed: {} (seed {:016x})", failed.reason, failed.seed);
      if (summary_.is_in_progress) {
        note(name_of(id), std::move(what));
      } else {
        add(id, std::move(what));
      }
    }
  }

  void check_summary() {
    if (!is_sealed()) return;
    try {
      const std::optional<DatasetSummary> said = read_dataset_summary(directory_);
      if (!said) {
        add(summary_name, "missing");
      } else if (said->digest != summary_.digest) {
        add(summary_name, fmt::format("digest: found {}, expected {}, that of the manifest", said->digest,
                                      summary_.digest));
      } else if (said->cases != summary_.cases || said->recipe_cases != state_.size()) {
        add(summary_name, fmt::format("found {} of {} cases, expected {} of {}", said->cases,
                                      said->recipe_cases, summary_.cases, state_.size()));
      }
    } catch (const InputError& error) {
      add(summary_name, complaint_of(error));
    }
  }

  // Beside a run in progress, journals of runs that have ended wait for its end.
  void report_journals() {
    for (const fs::path& journal : in_use_) {
      note(journal.filename().string(), "a run is in progress; only what was finished before is checked");
    }
    if (summary_.is_in_progress) return;
    for (const fs::path& journal : journals_) {
      add(journal.filename().string(),
          "its run has ended, but its cases are not in the manifest yet; the same command resumes it, and "
          "--repair completes the manifest");
    }
  }

  // In the folders of cases.
  void find_unlisted_files() {
    if (summary_.is_in_progress) expect_files_to_come();
    std::set<std::string> folders;
    for (const auto& [id, state] : state_) folders.insert(folder_name(id.set, id.tubes));
    for (const std::string& folder : folders) {
      if (!fs::is_directory(directory_ / folder)) continue;
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory_ / folder)) {
        const std::string path = entry.path().lexically_relative(directory_).string();
        if (!entry.is_directory() && !listed_.contains(path)) add(path, "not in the manifest");
      }
    }
  }

  void expect_files_to_come() {
    for (const auto& [id, state] : state_) {
      if (!state.is_there) listed_.merge(paths_to_come(id));
    }
  }

  std::unordered_set<std::string> paths_to_come(const CaseId& id) const {
    const std::vector<std::string> paths = paths_of(summary_.recipe, id);
    return {paths.begin(), paths.end()};
  }

  // Beside the folders of cases, where the user may keep files, too.
  void find_strays() {
    const std::set<std::string> kinds{".toml", ".json", ".jsonl"};
    for (const fs::directory_entry& entry : fs::directory_iterator(directory_)) {
      const std::string name = entry.path().filename().string();
      const bool is_own = std::ranges::find(dataset_files, name) != dataset_files.end();
      const bool looks_own = entry.is_regular_file() && kinds.contains(entry.path().extension().string());
      const bool is_journal = std::ranges::find(journals_, entry.path()) != journals_.end();
      if (looks_own && !is_own && !is_journal) note(name, "is none of the dataset's files");
    }
  }

  void check_cases() {
    std::vector<CaseId> there;
    for (const auto& [id, state] : state_) {
      if (state.is_there && state.is_wanted) there.push_back(id);
    }
    RunProgress progress{.wanted = there.size()};
    observer_.begun(there);
    const auto check = [&](std::size_t task) {
      std::string lines;
      for (const auto& [where, what] : faults_of(there[task])) {
        lines += fmt::format("{}\t{}\n", where, what);
      }
      return lines;
    };
    const auto take = [&](const std::vector<TaskResult>& results) {
      for (const TaskResult& result : results) {
        take_faults(there[result.task], result.text);
        ++progress.made;
        observer_.ended({there[result.task], result.seconds, 0, {}}, progress);
      }
    };
    const auto give_up = [&](const TaskFailure& failure) {
      add(there[failure.task], "cannot be verified: " + failure.reason);
      ++progress.failed;
      observer_.ended({there[failure.task], 0, 0, failure.reason}, progress);
    };
    const bool all = run_in_workers(settings_.jobs, there.size(), check,
                                    {.done = take,
                                     .failed = give_up,
                                     .tick = [&] { observer_.progress(progress); },
                                     .stopping = observer_.stopping});
    summary_.was_stopped = !all;
  }

  std::vector<DatasetFault> faults_of(const CaseId& id) const {
    try {
      return faults_of_case(directory_, summary_.recipe, catalogue_.record(id), settings_.rest);
    } catch (const InputError& error) {
      return {{name_of(id), complaint_of(error)}};
    }
  }

  void take_faults(const CaseId& id, const std::string& lines) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) {
      const std::size_t middle = line.find('\t');
      add(line.substr(0, middle), line.substr(middle + 1));
      state_[id].is_broken = true;
    }
  }

  void list_broken_cases() {
    std::vector<CaseId> missing;
    std::size_t wanted = 0;
    for (const CaseId& id : cases(summary_.recipe)) {
      const State& state = state_.at(id);
      if (!state.is_wanted) continue;
      ++wanted;
      const bool is_missing = !state.is_there && !summary_.is_in_progress;
      if (is_missing && !state.is_broken) missing.push_back(id);
      if (is_missing || state.is_broken) summary_.broken.push_back(id);
    }
    std::ranges::stable_sort(summary_.faults, {}, &DatasetFault::where);
    std::ranges::stable_sort(summary_.notes, {}, &DatasetFault::where);
    if (missing.empty()) return;
    add("missing",
        fmt::format("{} of {} cases: {}", missing.size(), wanted, text_of_ranges(ranges_of(missing))));
  }

  const fs::path& directory_;
  const VerifySettings& settings_;
  const RunObserver& observer_;
  std::optional<DirectoryReadLock> lock_;  ///< until all that lists cases is read
  const std::vector<fs::path> journals_;
  const std::vector<fs::path> in_use_;  ///< of them, those of runs in progress
  const Catalogue catalogue_;
  std::map<CaseId, State> state_;           ///< of the recipe's cases
  std::map<std::string, CaseId> scenes_;    ///< by the checksum of their configurations
  std::unordered_set<std::string> listed_;  ///< paths in the manifest
  VerifySummary summary_;
};

}  // namespace

VerifySummary verify_dataset(const fs::path& directory, const VerifySettings& settings,
                             const RunObserver& observer) {
  validate_jobs(settings.jobs);
  return Verification(directory, recipe_in(directory), settings, observer).run();
}

}  // namespace tanglebin
