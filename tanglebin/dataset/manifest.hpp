#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {

// The files of a dataset's directory that list its cases, and their summary (docs/formats.md).
inline constexpr const char* manifest_name = "manifest.jsonl";
inline constexpr const char* times_name = "times.jsonl";
inline constexpr const char* failed_name = "failed.jsonl";
inline constexpr const char* summary_name = "dataset.json";

/// A file in the manifest.
struct FileRecord {
  std::string path;  ///< relative to the dataset's directory
  std::size_t bytes;
  std::string sha256;
};

/// A scanner with a name in the manifest.
struct ScannerRecord {
  std::string name;
  std::size_t points;  ///< in its cloud
};

/// A case in the manifest: only what follows from the recipe, so a recipe's manifest is always the same, byte
/// for byte. Durations are elsewhere (TimesRecord).
struct CaseRecord {
  CaseId id;
  std::uint64_t seed;
  double simulated;        ///< s
  double largest_overlap;  ///< m
  std::size_t points;      ///< in the cloud, of the first scanner
  std::vector<Rejection> rejections;
  std::vector<FileRecord> files;
  std::vector<ScannerRecord> scanners{};  ///< if the recipe's have names
  std::vector<DrawnNumber> drawn{};       ///< if the recipe has random numbers
};

/// How long a case took, and the largest size of the process that made it.
struct TimesRecord {
  CaseId id;
  StageTimes times;
  double peak_memory;  ///< MiB, resident
};

/// One line of JSON, without its end (docs/formats.md).
std::string to_json(const CaseRecord& record);
std::string to_json(const TimesRecord& record);

/// The inverse. Throws InputError with file and line for anything that to_json() does not write.
CaseRecord case_record(const std::string& json, const std::string& file, std::size_t line);
TimesRecord times_record(const std::string& json, const std::string& file, std::size_t line);

}  // namespace tanglebin
