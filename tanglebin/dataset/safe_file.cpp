#include "tanglebin/dataset/safe_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::error_code& reason) {
  throw InputError({.file = file.string(), .line = 0, .field = {}}, what + ": " + reason.message());
}

std::error_code last_error() {
  return {errno, std::generic_category()};
}

/// An open file descriptor.
class Descriptor {
public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool is_open() const { return descriptor_ >= 0; }

  std::error_code write_all(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        return last_error();
      }
    }
    return {};
  }

  std::error_code sync() const { return ::fsync(descriptor_) == 0 ? std::error_code{} : last_error(); }

  // A network file system may report only here that a write failed.
  std::error_code close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0 ? std::error_code{} : last_error();
  }

private:
  int descriptor_;
};

/// A new file under a name that no other process or thread has; removed at the end of the scope unless
/// renamed before.
class TemporaryFile {
public:
  explicit TemporaryFile(fs::path directory) : directory_(std::move(directory)) {}
  ~TemporaryFile() {
    if (exists_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::error_code fill(std::string_view bytes) {
    Descriptor file(create());
    if (!file.is_open()) return last_error();
    exists_ = true;
    if (const std::error_code error = file.write_all(bytes)) return error;
    if (const std::error_code error = file.sync()) return error;
    return file.close();
  }

  std::error_code rename_to(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return last_error();
    exists_ = false;
    return {};
  }

private:
  int create() {
    static std::atomic<unsigned> counter{0};
    int descriptor = -1;
    do {
      // Not derived from the final name, which may be as long as names can be.
      path_ = directory_ / fmt::format(".tanglebin-{}-{}.tmp", ::getpid(), counter++);
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);  // left by a process that was killed, or another machine's
    return descriptor;
  }

  fs::path directory_;
  fs::path path_;
  bool exists_ = false;
};

bool is_device_or_pipe(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::is_character_file(status) || fs::is_block_file(status) || fs::is_fifo(status) ||
         fs::is_socket(status);
}

std::error_code write_into(const fs::path& device, std::string_view bytes) {
  Descriptor file(::open(device.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open()) return last_error();
  if (const std::error_code error = file.write_all(bytes)) return error;
  return file.close();
}

std::error_code write_beside_and_rename(const fs::path& target, std::string_view bytes) {
  TemporaryFile temporary(target.parent_path());
  if (const std::error_code error = temporary.fill(bytes)) return error;
  return temporary.rename_to(target);
}

std::error_code write_whole(const fs::path& file, std::string_view bytes) {
  if (is_device_or_pipe(file)) return write_into(file, bytes);
  std::error_code error;
  const bool is_link = fs::is_symlink(fs::symlink_status(file, error));
  const fs::path target = is_link ? fs::canonical(file, error) : file;
  if (is_link && error) return error;
  return write_beside_and_rename(target, bytes);
}

/// The part of the path that exists but is no directory; empty where there is none.
fs::path obstacle(const fs::path& directory) {
  fs::path part;
  for (const fs::path& name : directory) {
    part /= name;
    std::error_code ignored;
    const fs::file_status status = fs::status(part, ignored);
    if (fs::exists(status) && !fs::is_directory(status)) return part;
  }
  return {};
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  if (const std::error_code error = write_whole(file, bytes)) fail(file, "cannot write", error);
}

void make_directories(const std::filesystem::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (!error) return;
  const fs::path blocked = obstacle(directory);
  if (!blocked.empty()) {
    throw InputError({.file = blocked.string(), .line = 0, .field = {}}, "a file", "a directory");
  }
  fail(directory, "cannot make the directory", error);
}

}  // namespace tanglebin
