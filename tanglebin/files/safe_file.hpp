#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tanglebin {

/// Why the last system call failed: errno.
std::error_code last_error();

/// Throws for a file or directory that the system refused to write: "file: what: reason". An InputError if
/// the path is wrong, so that trying again would not help (no such directory, a name too long, …); otherwise
/// a SystemError.
[[noreturn]] void throw_refusal(const std::filesystem::path& file, const std::string& what,
                                const std::error_code& reason);

/// Writes `bytes` to `file` atomically: to a temporary file in the same directory, which is then renamed and
/// may replace an existing file. File and name are on disk when this returns. A symbolic link is followed; a
/// device or pipe is written directly. On failure, leaves nothing behind and throws as throw_refusal() does,
/// with the file and the reason ("No space left on device", "Permission denied", "Is a directory", …).
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Writes several files, each a name and its bytes, as write_file() does. None gets its name before the bytes
/// of all are on disk, so if one cannot be written, all stay as they were.
void write_files(const std::vector<std::pair<std::filesystem::path, std::string>>& files);

/// Throws InputError naming the existing part of a directory's path that is a file, if there is one.
void expect_no_file_in_the_way(const std::filesystem::path& directory);

/// Creates a directory and its missing parents, and waits until their names are on disk. Throws InputError
/// naming a file that is in the way, and otherwise as throw_refusal() does.
void make_directories(const std::filesystem::path& directory);

/// Throws InputError if the folder of `file`, of which the end may not exist yet, is not below `directory`
/// after following symbolic links. The directory must exist.
void expect_below(const std::filesystem::path& directory, const std::filesystem::path& file);

/// Writes all bytes to an open file. Throws as throw_refusal() does.
void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& file);

/// Waits until the names in the directory, including those of files renamed before, are on disk. Throws as
/// throw_refusal() does.
void sync_directory(const std::filesystem::path& directory);

/// A file written piece by piece under a temporary name in the directory `staging`, which must be on the same
/// disk. commit() gives it its own name once its data is on disk; without commit(), it is removed. The new
/// name is on disk after sync_directory(). All functions throw as write_file() does.
class StagedFile {
public:
  StagedFile(std::filesystem::path file, const std::filesystem::path& staging);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  void append(std::string_view bytes);

  /// Waits until the bytes are on disk. Nothing can be appended afterwards.
  void finish();
  void commit();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Writes a StagedFile with these bytes.
void write_staged(const std::filesystem::path& file, std::string_view bytes,
                  const std::filesystem::path& staging);

}  // namespace tanglebin
