#include "tanglebin/files/safe_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

bool is_of_a_wrong_path(const std::error_code& reason) {
  constexpr std::array reasons{std::errc::no_such_file_or_directory, std::errc::not_a_directory,
                               std::errc::is_a_directory, std::errc::filename_too_long,
                               std::errc::too_many_symbolic_link_levels};
  return std::ranges::any_of(reasons, [&](std::errc wrong) { return reason == wrong; });
}

std::error_code write_bytes(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return last_error();
    }
  }
  return {};
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

  std::error_code write_all(std::string_view bytes) const { return write_bytes(descriptor_, bytes); }

  std::error_code sync() const { return ::fsync(descriptor_) == 0 ? std::error_code{} : last_error(); }

  // A network file system may report only now that a write failed.
  std::error_code close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0 ? std::error_code{} : last_error();
  }

private:
  int descriptor_;
};

/// A new file whose name no other process or thread uses; removed at the end of the scope unless renamed.
class TemporaryFile {
public:
  explicit TemporaryFile(fs::path directory) : directory_(std::move(directory)) {}
  ~TemporaryFile() {
    if (exists_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::error_code create() {
    static std::atomic<unsigned> counter{0};
    int descriptor = -1;
    do {
      // Not derived from the final name, which may already have the maximum length.
      path_ = directory_ / fmt::format(".tanglebin-{}-{}.tmp", ::getpid(), counter++);
      descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 &&
             errno == EEXIST);  // left over from a process that was killed, or on another machine
    if (descriptor < 0) return last_error();
    exists_ = true;
    file_ = std::make_unique<Descriptor>(descriptor);
    return {};
  }

  std::error_code append(std::string_view bytes) const { return file_->write_all(bytes); }

  std::error_code finish() {
    if (file_ == nullptr) return {};
    const std::unique_ptr<Descriptor> file = std::move(file_);
    if (const std::error_code error = file->sync()) return error;
    return file->close();
  }

  std::error_code rename_to(const fs::path& target) {
    if (const std::error_code error = finish()) return error;
    if (::rename(path_.c_str(), target.c_str()) != 0) return last_error();
    exists_ = false;
    return {};
  }

private:
  fs::path directory_;
  fs::path path_;
  std::unique_ptr<Descriptor> file_;
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

fs::path directory_of(const fs::path& file) {
  const fs::path directory = file.parent_path();
  return directory.empty() ? fs::path(".") : directory;
}

std::error_code sync_names_in(const fs::path& directory) {
  Descriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.is_open()) return last_error();
  const std::error_code error = opened.sync();
  // Some file systems do not support this, or do not need it.
  return error == std::errc::invalid_argument ? std::error_code{} : error;
}

std::error_code write_beside_and_rename(const fs::path& target, std::string_view bytes) {
  TemporaryFile temporary(directory_of(target));
  if (const std::error_code error = temporary.create()) return error;
  if (const std::error_code error = temporary.append(bytes)) return error;
  if (const std::error_code error = temporary.rename_to(target)) return error;
  return sync_names_in(directory_of(target));
}

// Makes the name of a symbolic link that of the file that it leads to.
std::error_code follow_link(fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(file, error))) return {};
  fs::path target = fs::canonical(file, error);
  if (!error) file = std::move(target);
  return error;
}

std::error_code write_whole(fs::path file, std::string_view bytes) {
  if (is_device_or_pipe(file)) return write_into(file, bytes);
  if (const std::error_code error = follow_link(file)) return error;
  return write_beside_and_rename(file, bytes);
}

// With its bytes on disk, and without its name.
std::unique_ptr<StagedFile> staged_beside(fs::path file, std::string_view bytes) {
  if (const std::error_code error = follow_link(file)) throw_refusal(file, "cannot write", error);
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw_refusal(file, "cannot write", std::make_error_code(std::errc::is_a_directory));
  auto staged = std::make_unique<StagedFile>(file, directory_of(file));
  staged->append(bytes);
  staged->finish();
  return staged;
}

}  // namespace

std::error_code last_error() {
  return {errno, std::generic_category()};
}

void throw_refusal(const std::filesystem::path& file, const std::string& what,
                   const std::error_code& reason) {
  const std::string problem = what + ": " + reason.message();
  if (is_of_a_wrong_path(reason)) throw InputError({.file = file.string(), .line = 0, .field = {}}, problem);
  throw SystemError(file.string(), problem);
}

void write_file(const std::filesystem::path& file, std::string_view bytes) {
  if (const std::error_code error = write_whole(file, bytes)) throw_refusal(file, "cannot write", error);
}

void write_files(const std::vector<std::pair<std::filesystem::path, std::string>>& files) {
  std::vector<std::unique_ptr<StagedFile>> staged;
  for (const auto& [file, bytes] : files) {
    if (!is_device_or_pipe(file)) staged.push_back(staged_beside(file, bytes));
  }
  for (const auto& [file, bytes] : files) {
    if (is_device_or_pipe(file)) write_file(file, bytes);
  }
  for (const auto& file : staged) file->commit();
  for (const auto& [file, bytes] : files) {
    if (!is_device_or_pipe(file)) sync_directory(directory_of(file));
  }
}

void expect_no_file_in_the_way(const std::filesystem::path& directory) {
  fs::path part;
  for (const fs::path& name : directory) {
    part /= name;
    std::error_code ignored;
    const fs::file_status status = fs::status(part, ignored);
    if (fs::exists(status) && !fs::is_directory(status))
      throw InputError({part.string(), 0, ""}, "a file", "a directory");
  }
}

void make_directories(const std::filesystem::path& directory) {
  std::error_code error;
  if (fs::is_directory(directory, error)) return;
  // Directories above an existing one are already on disk.
  std::vector<fs::path> changed{directory_of(directory)};
  while (fs::status(changed.back(), error).type() == fs::file_type::not_found) {
    changed.push_back(directory_of(changed.back()));
  }
  fs::create_directories(directory, error);
  if (!error) {
    for (const fs::path& parent : changed) sync_directory(parent);
    return;
  }
  expect_no_file_in_the_way(directory);
  throw_refusal(directory, "cannot make the directory", error);
}

void expect_below(const std::filesystem::path& directory, const std::filesystem::path& file) {
  std::error_code error;
  const fs::path top = fs::canonical(directory, error);
  if (error) throw_refusal(directory, "cannot be opened", error);
  const fs::path folder = fs::weakly_canonical(directory_of(file), error);
  if (error) throw_refusal(file, "cannot be opened", error);
  if (std::ranges::mismatch(top, folder).in1 != top.end()) {
    throw InputError({.file = file.string(), .line = 0, .field = {}},
                     "a folder that leads to " + folder.string(), "a folder below the dataset's directory");
  }
}

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& file) {
  if (const std::error_code error = write_bytes(descriptor, bytes))
    throw_refusal(file, "cannot write", error);
}

void sync_directory(const std::filesystem::path& directory) {
  if (const std::error_code error = sync_names_in(directory)) throw_refusal(directory, "cannot write", error);
}

struct StagedFile::Implementation {
  fs::path file;
  TemporaryFile temporary;

  void expect(const std::error_code& error) const {
    if (error) throw_refusal(file, "cannot write", error);
  }
};

StagedFile::StagedFile(std::filesystem::path file, const std::filesystem::path& staging)
    : implementation_(new Implementation{.file = std::move(file), .temporary = TemporaryFile(staging)}) {
  implementation_->expect(implementation_->temporary.create());
}

StagedFile::~StagedFile() = default;

void StagedFile::append(std::string_view bytes) {
  implementation_->expect(implementation_->temporary.append(bytes));
}

void StagedFile::finish() {
  implementation_->expect(implementation_->temporary.finish());
}

void StagedFile::commit() {
  implementation_->expect(implementation_->temporary.rename_to(implementation_->file));
}

void write_staged(const std::filesystem::path& file, std::string_view bytes,
                  const std::filesystem::path& staging) {
  StagedFile staged(file, staging);
  staged.append(bytes);
  staged.commit();
}

}  // namespace tanglebin
