#include "tanglebin/runs/file_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "tanglebin/io/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file) {
  throw_refusal(file, "cannot be locked", {errno, std::generic_category()});
}

bool try_to_lock(int descriptor, const fs::path& file) {
  struct flock whole_file {};
  whole_file.l_type = F_WRLCK;
  whole_file.l_whence = SEEK_SET;
  if (fcntl(descriptor, F_OFD_SETLK, &whole_file) == 0) return true;
  if (errno != EAGAIN && errno != EACCES) fail(file);
  return false;
}

// False if the run that had the lock before has removed the file, even if another run has created it again.
// (On NFS the name may be cached; a removed file has no names in any case.)
bool is_still_the_file(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && opened.st_nlink > 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

FileLock wait_for(const fs::path& file) {
  while (true) {
    if (std::optional<FileLock> lock = FileLock::take(file)) return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

std::optional<FileLock> FileLock::take(const fs::path& file) {
  while (true) {
    FileLock lock(open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (lock.descriptor_ < 0) fail(file);
    if (!try_to_lock(lock.descriptor_, file)) return std::nullopt;
    if (is_still_the_file(lock.descriptor_, file)) return lock;
  }
}

DirectoryLock::DirectoryLock(const fs::path& directory)
    : file_(directory / ".lock"), lock_(wait_for(file_)) {}

DirectoryLock::~DirectoryLock() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace tanglebin
