#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/recipe/case_id.hpp"

namespace tanglebin {

/// A case that could not be made.
struct FailedCase {
  CaseId id;
  std::uint64_t seed = 0;  ///< of its first attempt
  std::string reason;
};

/// A line of failed.jsonl, without the line's end, and the inverse, which throws InputError.
std::string to_json(const FailedCase& failed);
FailedCase failed_case(const std::string& json, const std::string& file, std::size_t line);

/// What manifest, times, failures and journals of a dataset's directory say of its cases. It has in memory
/// only where the lines are, so that it is small whatever the dataset is.
class Catalogue {
public:
  /// What to do with a line of manifest, times or failures that cannot be read.
  enum class Damage { is_error, is_passed_over };

  /// Reads them, all journals or these only. A last line that was cut off is passed over, and so is what
  /// cannot be read in a journal. Throws InputError for any other line that is not about a case, unless
  /// damage is passed over, and for a file that cannot be read.
  explicit Catalogue(const std::filesystem::path& directory, Damage damage = Damage::is_error);
  Catalogue(const std::filesystem::path& directory, Damage damage,
            const std::vector<std::filesystem::path>& journals);

  bool has(const CaseId& id) const { return places_.contains(id); }

  /// Cases that failed and are not there.
  const std::map<CaseId, FailedCase>& failed() const { return failed_; }

  /// The cases that are there.
  std::vector<CaseId> cases() const;

  /// What is known of a case that is there. Each call opens the file, so that forked processes may call it.
  CaseRecord record(const CaseId& id) const;
  std::optional<TimesRecord> times(const CaseId& id) const;

  /// Forgets a case.
  void drop(const CaseId& id) { places_.erase(id); }

  /// Adds a case that failed, where it is not there.
  void add(const FailedCase& failed);

  /// Writes manifest.jsonl, times.jsonl, failed.jsonl (where cases have failed) and dataset.json, the cases
  /// in the order of `order`, others left out; `made_with` joins the versions that dataset.json has.
  /// Unfinished files go to `staging`. All is on the disk when it returns. Throws InputError where a line
  /// cannot be read or a file cannot be written.
  DatasetSummary write(const std::vector<CaseId>& order, const std::set<Versions>& made_with,
                       const std::filesystem::path& staging) const;

private:
  struct Place {
    std::size_t file = 0;
    std::uint64_t offset = 0;
    std::size_t size = 0;
    std::size_t line = 0;
  };
  struct Places {
    Place record;
    Place times;
  };
  class Reader;

  void read_journal(const std::filesystem::path& file);
  template <typename Take>
  void read_lines(const std::filesystem::path& file, Damage damage, const Take& take);

  std::filesystem::path directory_;
  std::vector<std::filesystem::path> files_;
  std::map<CaseId, Places> places_;
  std::map<CaseId, FailedCase> failed_;
};

}  // namespace tanglebin
