#pragma once

#include <filesystem>

namespace tanglebin {

/// Keeps a directory for one run and its workers. The kernel gives it back when the last of them ends.
class DirectoryLock {
public:
  /// Throws InputError where another run has the directory.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  int descriptor_;
};

}  // namespace tanglebin
