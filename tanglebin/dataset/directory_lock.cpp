#include "tanglebin/dataset/directory_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tanglebin/base/error.hpp"

namespace tanglebin {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory)
    : descriptor_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw InputError({directory.string(), 0, ""}, std::strerror(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    throw InputError({directory.string(), 0, ""}, "another run is writing here");
  }
}

DirectoryLock::~DirectoryLock() {
  close(descriptor_);
}

}  // namespace tanglebin
