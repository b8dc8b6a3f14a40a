#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

// Internal to the library: reads files, and distinguishes missing files from unreadable ones. Nothing here
// but open_input() waits for a pipe or reads a device: what is not a regular file is an InputError.
namespace tanglebin {

/// The most bytes of a file that is read as a whole and is small by its nature: a recipe, a summary, a
/// picture.
inline constexpr std::size_t most_bytes_of_small_file = 1U << 24U;

/// Opens a file; nullopt if it does not exist. Throws InputError with the reason if it exists but cannot be
/// opened, or is not a regular file.
std::optional<std::ifstream> open_if_there(const std::filesystem::path& file);

/// Opens what a user names as a command's input: a file, a pipe or a device. Throws InputError for a
/// directory, which Linux would open, and with the reason if it cannot be opened.
std::ifstream open_input(const std::filesystem::path& file);

/// Throws InputError with the reason if reading this file's stream failed.
void expect_read(const std::ifstream& in, const std::filesystem::path& file);

/// All bytes of a stream. Throws InputError naming it if there are more than `most`.
std::string read_bytes(std::istream& in, const std::string& name,
                       std::size_t most = most_bytes_of_small_file);

/// All bytes of a file; nullopt if it does not exist. Throws as the functions above.
std::optional<std::string> read_if_there(const std::filesystem::path& file,
                                         std::size_t most = most_bytes_of_small_file);

/// The same for a file that must exist.
std::string read_file(const std::filesystem::path& file, std::size_t most = most_bytes_of_small_file);

/// A line of a file, without its end.
struct FileLine {
  const std::string& text;
  std::size_t number;  ///< from 1
  bool is_whole;       ///< false for a last line without an end
};

/// Calls `take` with every line of a file. A missing file has none. Throws InputError as the functions above,
/// and for a line of more than 64 MiB.
void for_each_line(const std::filesystem::path& file, const std::function<void(const FileLine&)>& take);

}  // namespace tanglebin
