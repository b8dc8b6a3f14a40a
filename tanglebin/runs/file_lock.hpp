#pragma once

#include <filesystem>
#include <optional>

namespace tanglebin {

/// An open file that one run keeps for itself: an "open file description" lock (fcntl(2), F_OFD_SETLK), which
/// a process shares with those that it forks, which the kernel gives back when the last of them ends, and
/// which holds between machines where the file system is shared (NFS 4; Lustre mounted with `flock`).
class FileLock {
public:
  /// Opens the file for reading and appending, makes it where it is missing, and locks it; nullopt where
  /// another run has it. Throws InputError where the file cannot be opened or is a symbolic link.
  static std::optional<FileLock> take(const std::filesystem::path& file);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

  int descriptor() const { return descriptor_; }

private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

/// A directory's lock, for the moments in which a run reads or writes what runs of other names read or write,
/// too. Waits for it without limit: who has it is at work, or has ended, and then the kernel gives it back.
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
