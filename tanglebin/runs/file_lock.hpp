#pragma once

#include <filesystem>
#include <optional>

namespace tanglebin {

/// An open file that one run keeps for itself, by an "open file description" lock (fcntl(2), F_OFD_SETLK). A
/// process shares it with its forks, and the kernel releases it when the last of them ends. It also works
/// between machines on a shared file system (NFS 4; Lustre mounted with `flock`).
class FileLock {
public:
  /// Opens the file for reading and appending, creates it if missing, and locks it; nullopt if another run
  /// has the lock. Throws as throw_refusal() does if the file cannot be opened or is a symbolic link.
  static std::optional<FileLock> take(const std::filesystem::path& file);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

  int descriptor() const { return descriptor_; }

private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

/// A directory's lock, held while a run reads or writes files that runs of other names use too. Waits for it
/// without limit: its owner is at work, or has ended, and then the kernel releases it.
class DirectoryLock {
public:
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  std::filesystem::path file_;
  FileLock lock_;
};

}  // namespace tanglebin
