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
  friend class DirectoryLock;
  friend class DirectoryReadLock;
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

/// Whether somebody has the FileLock of this file, which need not exist.
bool is_locked(const std::filesystem::path& file);

/// A directory's lock, held while a run changes files that other runs use too. It is a lock of the file
/// `.lock`, which is created once and stays. Waits for it without limit: its owner is at work, or has ended,
/// and then the kernel releases it.
class DirectoryLock {
public:
  explicit DirectoryLock(const std::filesystem::path& directory);

private:
  FileLock lock_;
};

/// The same for those who read these files: many may hold it at a time, but none beside a DirectoryLock.
/// Holds nothing if there is no `.lock`, so that no run has been here, or if it cannot be locked, as on a
/// read-only file system without locks.
class DirectoryReadLock {
public:
  explicit DirectoryReadLock(const std::filesystem::path& directory);

private:
  FileLock lock_;
};

}  // namespace tanglebin
