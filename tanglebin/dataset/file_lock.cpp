#include "tanglebin/dataset/file_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file) {
  throw InputError({file.string(), 0, ""}, std::strerror(errno));
}

bool try_to_lock(int descriptor, const fs::path& file) {
  struct flock whole_file {};
  whole_file.l_type = F_WRLCK;
  whole_file.l_whence = SEEK_SET;
  if (fcntl(descriptor, F_OFD_SETLK, &whole_file) == 0) return true;
  if (errno != EAGAIN && errno != EACCES) fail(file);
  return false;
}

// Not where the run that had the lock before has removed the file, and maybe another one has made it anew.
bool is_still_the_file(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const fs::path& file, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    FileLock lock(open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0) fail(file);
    const bool is_locked = try_to_lock(lock.descriptor_, file);
    if (is_locked && is_still_the_file(lock.descriptor_, file)) return lock;
    if (!is_locked && std::chrono::steady_clock::now() >= end) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace tanglebin
