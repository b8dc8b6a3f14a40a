#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

// Internal to the library: reading files so that none that cannot be read is taken for one that is not there.
namespace tanglebin {

/// The file, open; nullopt where there is none. Throws InputError with the reason where it is there and
/// cannot be opened.
std::optional<std::ifstream> open_if_there(const std::filesystem::path& file);

/// Throws InputError with the reason where the stream of this file could not be read.
void expect_read(const std::ifstream& in, const std::filesystem::path& file);

/// All bytes of a file, or the first `most`; nullopt where there is none. Throws as the functions above.
std::optional<std::string> read_if_there(const std::filesystem::path& file,
                                         std::size_t most = std::numeric_limits<std::size_t>::max());

/// The same of a file that must be there.
std::string read_file(const std::filesystem::path& file,
                      std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace tanglebin
