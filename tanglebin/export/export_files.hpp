#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "tanglebin/export/archive.hpp"

namespace tanglebin {

/// Writes the files of an export. All functions throw as write_file() does (files/safe_file.hpp).
class ExportFiles {
public:
  /// Unfinished files go to `staging`, which must be on the same disk.
  ExportFiles(std::filesystem::path directory, std::filesystem::path staging);

  const std::filesystem::path& directory() const { return directory_; }

  /// Writes a file, whole or not at all; `path` is relative to the export's directory.
  void write(const std::string& path, std::string_view bytes);

  /// Writes a file with what `produce` gives to the sink, and waits until it and all files before it are on
  /// the disk. So when it is there, they are.
  void seal(const std::string& path, const std::function<void(const Sink&)>& produce);
  void seal(const std::string& path, std::string_view bytes);

private:
  void sync_folders();

  std::filesystem::path directory_;
  std::filesystem::path staging_;
  std::set<std::filesystem::path> folders_;  ///< with names that may not be on the disk
};

}  // namespace tanglebin
