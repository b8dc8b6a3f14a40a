#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"

namespace tanglebin {

/// What is known of the cases that are finished, whose files are whole.
struct FinishedCases {
  std::map<CaseId, CaseRecord> records;
  std::map<CaseId, TimesRecord> times;
};

/// The journal's line for a finished case.
std::string journal_line(const CaseRecord& record, const TimesRecord& times);

/// What manifest, times and journal of a dataset's directory say. A last line of the journal that was cut off
/// is passed over; throws InputError for any other that cannot be read.
FinishedCases finished_cases(const std::filesystem::path& directory);

/// The text of times.jsonl: a line for each finished case in the order of `order`.
std::string times_text(const FinishedCases& finished, const std::vector<CaseId>& order);

/// Writes manifest.jsonl and times.jsonl, a line for each finished case in the order of `order`, and removes
/// the journal.
void write_manifest(const std::filesystem::path& directory, const FinishedCases& finished,
                    const std::vector<CaseId>& order);

}  // namespace tanglebin
