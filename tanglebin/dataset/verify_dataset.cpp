#include "tanglebin/dataset/verify_dataset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/dataset/verify_case.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// The verification of one dataset.
class Verification {
public:
  Verification(const fs::path& directory, Recipe recipe, const VerifySettings& settings,
               const RunObserver& observer)
      : directory_(directory),
        settings_(settings),
        observer_(observer),
        catalogue_(directory, Catalogue::Damage::is_passed_over) {
    summary_.recipe = std::move(recipe);
    for (const CaseId& id : cases(summary_.recipe)) state_.try_emplace(id);
  }

  VerifySummary run() {
    read_manifest();
    read_failures();
    check_summary();
    find_journals();
    find_unlisted_files();
    check_cases();
    list_broken_cases();
    return std::move(summary_);
  }

private:
  struct State {
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

  void read_manifest() {
    const fs::path file = directory_ / manifest_name;
    if (!fs::exists(file)) add(manifest_name, "missing");
    std::uintmax_t whole = 0;
    for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
      const std::string where = fmt::format("{}:{}", manifest_name, number);
      try {
        read_record(case_record(line, where, 0), where);
      } catch (const InputError& error) {
        add(where, complaint_of(error));
      }
      whole += line.size() + 1;
    });
    std::error_code none;
    if (const std::uintmax_t size = fs::file_size(file, none); !none && size > whole) {
      add(manifest_name, fmt::format("{} bytes after the last line", size - whole));
    }
    if (!fs::exists(directory_ / times_name)) add(times_name, "missing");
    summary_.digest = digest_.hex();
  }

  void read_record(const CaseRecord& record, const std::string& where) {
    digest_.add(record);
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
      if (const auto found = state_.find(id); found != state_.end() && !found->second.is_there) {
        add(id, fmt::format("failed: {} (seed {:016x})", failed.reason, failed.seed));
      }
    }
  }

  void check_summary() {
    constexpr const char* name = "dataset.json";
    try {
      const std::optional<DatasetSummary> said = read_dataset_summary(directory_);
      if (!said) {
        add(name, "missing");
      } else if (said->digest != summary_.digest) {
        add(name, fmt::format("digest: found {}, expected {}, that of the manifest", said->digest,
                              summary_.digest));
      } else if (said->cases != summary_.cases || said->recipe_cases != state_.size()) {
        add(name, fmt::format("found {} of {} cases, expected {} of {}", said->cases, said->recipe_cases,
                              summary_.cases, state_.size()));
      }
    } catch (const InputError& error) {
      add(name, complaint_of(error));
    }
  }

  void find_journals() {
    for (const fs::path& journal : journals_in(directory_)) {
      add(journal.filename().string(),
          "a run is in progress or was interrupted; the same command resumes it");
    }
  }

  // Only in the folders of cases; anything else in the directory is the user's.
  void find_unlisted_files() {
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

  void check_cases() {
    std::vector<CaseId> there;
    for (const auto& [id, state] : state_) {
      if (state.is_there) there.push_back(id);
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
    const bool all =
        run_in_workers(settings_.jobs, there.size(), check,
                       {.done = take, .failed = give_up, .tick = [&] { observer_.progress(progress); }});
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
    for (const CaseId& id : cases(summary_.recipe)) {
      const State& state = state_.at(id);
      if (!state.is_there && !state.is_broken) add(name_of(id), "missing");
      if (!state.is_there || state.is_broken) summary_.broken.push_back(id);
    }
    std::ranges::stable_sort(summary_.faults, {}, &DatasetFault::where);
  }

  const fs::path& directory_;
  const VerifySettings& settings_;
  const RunObserver& observer_;
  const Catalogue catalogue_;
  std::map<CaseId, State> state_;           ///< of the recipe's cases
  std::map<std::string, CaseId> scenes_;    ///< by the checksum of their configurations
  std::unordered_set<std::string> listed_;  ///< paths in the manifest
  Digest digest_;
  VerifySummary summary_;
};

}  // namespace

VerifySummary verify_dataset(const fs::path& directory, const VerifySettings& settings,
                             const RunObserver& observer) {
  return Verification(directory, read_recipe(directory / "recipe.toml"), settings, observer).run();
}

}  // namespace tanglebin
