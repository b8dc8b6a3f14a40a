#include "tanglebin/runs/file_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = ".lock";

[[noreturn]] void fail(const fs::path& file) {
  throw_refusal(file, "cannot be locked", last_error());
}

int open_to_lock(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) fail(file);
  return descriptor;
}

struct flock whole_file(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

bool try_to_lock(int descriptor, const fs::path& file) {
  struct flock lock = whole_file(F_WRLCK);
  if (fcntl(descriptor, F_OFD_SETLK, &lock) == 0) return true;
  if (errno != EAGAIN && errno != EACCES) fail(file);
  return false;
}

// False if it cannot be locked.
bool wait_for_lock(int descriptor, short type) {
  struct flock lock = whole_file(type);
  while (fcntl(descriptor, F_OFD_SETLKW, &lock) != 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

// False if the run that had the lock before has removed the file, even if another run has created it again.
// (On NFS the name may be cached; a removed file has no names in any case.)
bool is_still_the_file(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && opened.st_nlink > 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const fs::path& file) {
  while (true) {
    FileLock lock(open_to_lock(file));
    if (!try_to_lock(lock.descriptor_, file)) return std::nullopt;
    if (is_still_the_file(lock.descriptor_, file)) return lock;
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

bool is_locked(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  struct flock lock = whole_file(F_WRLCK);
  const bool is_known = fcntl(descriptor, F_OFD_GETLK, &lock) == 0;
  close(descriptor);
  return is_known && lock.l_type != F_UNLCK;
}

DirectoryLock::DirectoryLock(const fs::path& directory) : lock_(open_to_lock(directory / lock_name)) {
  if (!wait_for_lock(lock_.descriptor(), F_WRLCK)) fail(directory / lock_name);
}

DirectoryReadLock::DirectoryReadLock(const fs::path& directory)
    : lock_(open((directory / lock_name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)) {
  if (lock_.descriptor() >= 0) wait_for_lock(lock_.descriptor(), F_RDLCK);
}

}  // namespace tanglebin
