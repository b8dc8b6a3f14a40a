#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {

/// A file as the manifest lists it.
struct FileRecord {
  std::string path;  ///< relative to the dataset's directory
  std::size_t bytes;
  std::string sha256;
};

/// What the manifest says of a scanner that has a name.
struct ScannerRecord {
  std::string name;
  std::size_t points;  ///< in its cloud
};

/// What the manifest says of a case: only what follows from the recipe, so that the manifest of a recipe is
/// always the same, byte for byte. How long things took stands elsewhere (TimesRecord).
struct CaseRecord {
  CaseId id;
  std::uint64_t seed;
  double simulated;        ///< s
  double largest_overlap;  ///< m
  std::size_t points;      ///< in the cloud, of the first scanner
  std::vector<Rejection> rejections;
  std::vector<FileRecord> files;
  std::vector<ScannerRecord> scanners{};  ///< where the recipe's have names
  std::vector<DrawnNumber> drawn{};       ///< where the recipe has numbers that are drawn
};

/// How long a case took, and how large the process that made it had grown.
struct TimesRecord {
  CaseId id;
  StageTimes times;
  double peak_memory;  ///< MiB, resident
};

/// One line of JSON, without the line's end (docs/formats.md).
std::string to_json(const CaseRecord& record);
std::string to_json(const TimesRecord& record);

/// The inverse. Throws InputError with `place` for what to_json() did not write.
CaseRecord case_record(const std::string& json, const std::string& file, std::size_t line);
TimesRecord times_record(const std::string& json, const std::string& file, std::size_t line);

}  // namespace tanglebin
