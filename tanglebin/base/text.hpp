#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tanglebin {

/// Text from a file or the command line, for an error message: quoted, on one line, cut after 40 characters,
/// with \xNN for control characters and bytes that are not UTF-8.
std::string excerpt(std::string_view text);

/// Text that a terminal shows as it stands: control characters and bytes that are not UTF-8 become \n, \t or
/// \xNN.
std::string printable(std::string_view text);

/// The words of a line, separated by white space. They are views into `line`.
std::vector<std::string_view> words_of(std::string_view line);

/// The same, reusing a vector.
void words_of(std::string_view line, std::vector<std::string_view>& words);

/// The parts between separators: one more than there are separators. They are views into `text`.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Parses all of `text` as a number, in any locale. None if it is not a number or does not fit Number.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace tanglebin
