#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"

namespace tanglebin {

// The files of a dataset's directory that say what it has (docs/formats.md).
inline constexpr const char* manifest_name = "manifest.jsonl";
inline constexpr const char* times_name = "times.jsonl";
inline constexpr const char* failed_name = "failed.jsonl";

/// Between a case's record and its times in a line of the journal; JSON escapes a tab inside.
inline constexpr char journal_separator = '\t';

/// The journal's line for a finished case.
std::string journal_line(const CaseRecord& record, const TimesRecord& times);

/// What is known of the cases that are finished, whose files are whole.
struct FinishedCases {
  std::map<CaseId, CaseRecord> records;
  std::map<CaseId, TimesRecord> times;
};

/// What manifest, times and journals of a dataset's directory say. A last line that was cut off is passed
/// over; throws InputError for any other that cannot be read.
FinishedCases finished_cases(const std::filesystem::path& directory);

/// The text of times.jsonl: a line for each finished case in the order of `order`.
std::string times_text(const FinishedCases& finished, const std::vector<CaseId>& order);

}  // namespace tanglebin
