#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tanglebin {

/// Text from a file or the command line as an error message shows it: in quotes, on one line, cut after 40
/// characters, \xNN for what does not print.
std::string excerpt(std::string_view text);

/// The words of a line, separated by white space. They point into `line`.
std::vector<std::string_view> words_of(std::string_view line);

/// The same, into a vector that is used again.
void words_of(std::string_view line, std::vector<std::string_view>& words);

/// The parts between separators: one more than there are separators. They point into `text`.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The number that all of `text` is, in any locale; none where it is not one or does not fit Number.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace tanglebin
