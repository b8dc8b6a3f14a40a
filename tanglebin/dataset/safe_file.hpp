#pragma once

#include <filesystem>
#include <string_view>

namespace tanglebin {

/// Writes `bytes` to `file` so that it appears under its name only when it is whole and on the disk: into a
/// temporary file in the same directory, which then takes the name, also that of a file there before. Where
/// `file` is a symbolic link, what it points to is written; where it is a device or a pipe, the bytes go
/// straight into it. Leaves nothing behind on failure: throws InputError with the file and the reason ("No
/// space left on device", "Permission denied", "Is a directory", …).
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes the directory and those above it that are missing. Throws InputError with the path that stands in
/// the way and the reason.
void make_directories(const std::filesystem::path& directory);

}  // namespace tanglebin
