#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace tanglebin {

/// An open file that one run keeps for itself: an "open file description" lock (fcntl(2), F_OFD_SETLK), which
/// a process shares with those that it forks, which the kernel gives back when the last of them ends, and
/// which holds between machines where the file system is shared (NFS 4; Lustre mounted with `flock`).
class FileLock {
public:
  /// Opens the file for reading and appending, makes it where it is missing, and waits for the lock as long
  /// as `patience` at most; nullopt where another run has it for longer. Throws InputError where the file
  /// cannot be opened.
  static std::optional<FileLock> take(const std::filesystem::path& file, std::chrono::milliseconds patience);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;

  int descriptor() const { return descriptor_; }

private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace tanglebin
