#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"

namespace tanglebin {

/// What is known of the cases that are finished, whose files are whole.
struct FinishedCases {
  std::map<CaseId, CaseRecord> records;
  std::map<CaseId, TimesRecord> times;
};

/// The journal of a dataset's directory: a line for each case that has been finished since the manifest was
/// written. A run that is cut off leaves it behind; the next one reads it.
class Journal {
public:
  /// Opens it for this process and those that it forks. Throws InputError where that cannot be done.
  explicit Journal(const std::filesystem::path& directory);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Adds a case, on the disk when it returns. Lines of several processes do not mix.
  void append(const CaseRecord& record, const TimesRecord& times) const;

private:
  std::filesystem::path file_;
  int descriptor_;
};

/// What manifest, times and journal of the directory say. A last line of the journal that was cut off is
/// passed over; throws InputError for any other that cannot be read.
FinishedCases finished_cases(const std::filesystem::path& directory);

/// Writes manifest.jsonl and times.jsonl, a line for each finished case in the order of `order`, and removes
/// the journal.
void write_manifest(const std::filesystem::path& directory, const FinishedCases& finished,
                    const std::vector<CaseId>& order);

}  // namespace tanglebin
