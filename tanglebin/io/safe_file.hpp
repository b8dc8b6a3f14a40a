#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace tanglebin {

/// Writes `bytes` to `file` so that it appears under its name only when it is whole and on the disk: into a
/// temporary file in the same directory, which then takes the name, also that of a file there before. The new
/// name is on the disk, too, when it returns. Where `file` is a symbolic link, what it points to is written;
/// where it is a device or a pipe, the bytes go straight into it. Leaves nothing behind on failure: throws
/// InputError with the file and the reason ("No space left on device", "Permission denied", "Is a directory",
/// …).
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes the directory and those above it that are missing, names on the disk. Throws InputError with the
/// path that stands in the way and the reason.
void make_directories(const std::filesystem::path& directory);

/// Throws InputError where the folder of `file` is not below `directory` once symbolic links are followed.
/// Both must be there.
void expect_below(const std::filesystem::path& directory, const std::filesystem::path& file);

/// Writes all of the bytes to an open file. Throws InputError with the file's name and the reason.
void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& file);

/// Waits until the names in the directory are on the disk, as they are of files that took theirs before.
/// Throws InputError.
void sync_directory(const std::filesystem::path& directory);

/// A file that is written piece by piece under a temporary name in the directory `staging`, which is on the
/// same disk, and takes its own name, whole and on the disk, when it is committed; one that is not committed
/// is gone. The new name is on the disk after sync_directory(). Every function throws InputError as
/// write_file() does.
class StagedFile {
public:
  StagedFile(std::filesystem::path file, const std::filesystem::path& staging);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  void append(std::string_view bytes);
  void commit();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// A StagedFile of these bytes.
void write_staged(const std::filesystem::path& file, std::string_view bytes,
                  const std::filesystem::path& staging);

}  // namespace tanglebin
