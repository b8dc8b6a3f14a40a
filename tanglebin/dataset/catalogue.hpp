#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/runs/file_lock.hpp"
#include "tanglebin/runs/line_reader.hpp"

namespace tanglebin {

/// A case that was given up.
struct FailedCase {
  CaseId id;
  std::uint64_t seed = 0;  ///< of its first attempt
  std::string reason;
};

/// A line of failed.jsonl, without its end, and the inverse, which throws InputError.
std::string to_json(const FailedCase& failed);
FailedCase failed_case(const std::string& json, const std::string& file, std::size_t line);

/// Between a case's record and its times in a line of the journal; JSON escapes a tab inside.
inline constexpr char journal_separator = '\t';

/// The journal's first line: what the run's cases are made with.
std::string journal_header(const std::set<Versions>& made_with);

/// The journal's line for a finished case.
std::string journal_line(const CaseRecord& record, const TimesRecord& times);

/// Whether the journal has lines of cases, finished or failed.
bool lists_cases(const std::filesystem::path& journal);

/// The cases that are listed in the manifest, times, failures and journals of a dataset's directory. It keeps
/// only the places of their lines in memory, so it is small even for a large dataset.
class Catalogue {
public:
  /// What to do with a damaged line of manifest, times or failures.
  enum class Damage { is_error, is_passed_over };

  /// Reads them, with all journals or only these. With all, no run changes them meanwhile
  /// (DirectoryReadLock); the caller sees to that if it names the journals. Skips a last line without an end
  /// and damaged lines of journals. Throws InputError for any other line that does not begin with a case,
  /// unless damage is passed over, and for a file that cannot be read.
  explicit Catalogue(const std::filesystem::path& directory, Damage damage = Damage::is_error);
  Catalogue(const std::filesystem::path& directory, Damage damage,
            const std::vector<std::filesystem::path>& journals);

  /// Is the case finished?
  bool has(const CaseId& id) const { return places_.contains(id); }

  /// Cases that failed and have not been made since.
  const std::map<CaseId, FailedCase>& failed() const { return failed_; }

  /// The finished cases.
  std::vector<CaseId> cases() const;

  /// What the cases in the journals were made with.
  const std::set<Versions>& made_with() const { return made_with_; }

  /// The record of a finished case, and its times if there are any. A line that a run has moved meanwhile is
  /// looked up again. Throws InputError for a damaged line. Each call opens the file, so forked processes may
  /// call it.
  CaseRecord record(const CaseId& id) const;
  std::optional<TimesRecord> times(const CaseId& id) const;

  /// Calls `take` with each finished case's line of times.jsonl, if any, without its end, in the order of
  /// `order`.
  void for_each_times_line(const std::vector<CaseId>& order,
                           const std::function<void(const std::string&)>& take) const;

  /// Forgets a case.
  void drop(const CaseId& id) { places_.erase(id); }

  /// Adds a case that failed, unless it is finished.
  void add(const FailedCase& failed);

  /// Writes manifest.jsonl, times.jsonl, failed.jsonl (if cases have failed) and dataset.json, with the cases
  /// of `order` in that order and no others. `made_with` is for dataset.json. Unfinished files go to
  /// `staging`. Everything is on the disk when it returns. Throws InputError if a line cannot be read or a
  /// file cannot be written.
  DatasetSummary write(const std::vector<CaseId>& order, const std::set<Versions>& made_with,
                       const std::filesystem::path& staging) const;

private:
  struct Places {
    LinePlace record;
    LinePlace times;
  };

  Catalogue(const std::filesystem::path& directory, Damage damage, const DirectoryReadLock& lock);
  void read_journal(const std::filesystem::path& file);
  template <typename Take>
  void read_lines(const std::filesystem::path& file, Damage damage, const Take& take);

  // The finished case's places. Throws InputError if it is not listed.
  const Places& places_of(const CaseId& id) const;
  // The line at a case's place. Throws InputError if it is not of this case.
  std::string line_at(const CaseId& id, const LinePlace& place, LineReader& reader) const;
  std::optional<std::string> times_line(const CaseId& id, LineReader& reader) const;
  // What `read` returns of this catalogue, or of a later one if a run has moved the lines meanwhile.
  template <typename Read>
  auto up_to_date(const Read& read) const;

  std::filesystem::path directory_;
  Damage damage_;
  std::vector<std::filesystem::path> files_;
  std::map<CaseId, Places> places_;
  std::map<CaseId, FailedCase> failed_;
  std::set<Versions> made_with_;
  mutable std::shared_ptr<const Catalogue> later_;
};

}  // namespace tanglebin
