#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace tanglebin {

/// Where a line, or a part of one, is in one of several files.
struct LinePlace {
  std::size_t file = 0;      ///< index of the file
  std::uint64_t offset = 0;  ///< bytes
  std::size_t size = 0;      ///< bytes, without the line's end
  std::size_t line = 0;      ///< from 1
};

/// Reads lines by their places, so that a list of many lines need not be in memory. Keeps many files open,
/// but not more than a process may.
class LineReader {
public:
  explicit LineReader(const std::vector<std::filesystem::path>& files);

  /// Throws InputError if the file has been removed, is shorter than before or cannot be read.
  std::string line(const LinePlace& place);

private:
  struct File {
    std::filesystem::path path;
    std::optional<std::ifstream> in;
  };

  std::optional<std::ifstream> open(const std::filesystem::path& file);

  std::vector<File> files_;
  int open_ = 0;
};

}  // namespace tanglebin
