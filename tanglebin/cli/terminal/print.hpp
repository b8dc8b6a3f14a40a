#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "tanglebin/base/text.hpp"
#include "tanglebin/files/json_record.hpp"

// Printing that never throws: a run goes on even if the terminal or the reader is gone.
namespace tanglebin::cli {

/// A value to print: text, such as a file's name, becomes printable().
template <typename Value>
decltype(auto) shown(Value&& value) {
  if constexpr (std::is_convertible_v<Value, std::string_view>) {
    return printable(std::forward<Value>(value));
  } else {
    return std::forward<Value>(value);
  }
}

/// Formats the values as shown() and prints the text to standard output. main() reports lost output at the
/// end.
template <typename... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text =
      fmt::vformat(format, fmt::make_format_args(shown(std::forward<Values>(values))...));
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// The same to standard error.
template <typename... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text =
      fmt::vformat(format, fmt::make_format_args(shown(std::forward<Values>(values))...));
  std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Prints a line of JSON to standard output. Bytes that are not UTF-8, as in file names, are replaced.
inline void print_json_line(const Json& json) {
  const std::string line = json_text(json) + '\n';
  std::fwrite(line.data(), 1, line.size(), stdout);
}

}  // namespace tanglebin::cli
