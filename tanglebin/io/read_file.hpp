#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

// Internal to the library: reads files, and distinguishes missing files from unreadable ones.
namespace tanglebin {

/// Opens a file; nullopt if it does not exist. Throws InputError with the reason if it exists but cannot be
/// opened.
std::optional<std::ifstream> open_if_there(const std::filesystem::path& file);

/// Throws InputError with the reason if reading this file's stream failed.
void expect_read(const std::ifstream& in, const std::filesystem::path& file);

/// All bytes of a file, or the first `most`; nullopt if it does not exist. Throws as the functions above.
std::optional<std::string> read_if_there(const std::filesystem::path& file,
                                         std::size_t most = std::numeric_limits<std::size_t>::max());

/// The same for a file that must exist.
std::string read_file(const std::filesystem::path& file,
                      std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace tanglebin
