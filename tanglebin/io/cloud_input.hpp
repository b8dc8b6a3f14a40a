#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "tanglebin/base/error.hpp"

// Internal to the library: input of read_ply(), read_pcd() and read_configuration().
namespace tanglebin::cloud_format {

/// A cloud file that is being read: a text header, then text or binary data. May be a pipe. Uses memory only
/// in proportion to the data actually present.
class CloudInput {
public:
  CloudInput(std::istream& stream, std::string file) : stream_(stream), file_(std::move(file)) {}

  /// The next line without its LF or CRLF, valid until the next call. None at the end of the file. Throws
  /// InputError for an implausibly long line (binary data, or an endless stream).
  std::optional<std::string_view> next_line();

  /// Reads up to `size` bytes; fewer only at the end of the file.
  std::size_t read(std::byte* to, std::size_t size);

  /// Skips up to `size` bytes; fewer only at the end of the file.
  std::size_t skip(std::size_t size);

  bool at_end();

  /// Remaining bytes; 0 if unknown (a pipe).
  std::size_t remaining();

  const std::string& file() const { return file_; }
  std::size_t line() const { return line_; }

  /// The line read last, for an error message.
  InputPlace place(std::string field = "") const { return {file_, line_, std::move(field)}; }

  /// The file as a whole, or a value that is not on a line.
  InputPlace place_in_file(std::string field = "") const { return {file_, 0, std::move(field)}; }

private:
  std::istream& stream_;
  std::string file_;
  std::size_t line_ = 0;
  std::array<char, 1 << 16> buffer_;
};

}  // namespace tanglebin::cloud_format
