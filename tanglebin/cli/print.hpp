#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

// Printing that never throws: a run goes on even if the terminal or the reader is gone.
namespace tanglebin::cli {

/// Prints formatted text to standard output. main() reports lost output at the end.
template <typename... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// Prints a line of JSON to standard output. Bytes that are not UTF-8, as in file names, are replaced.
inline void print_json_line(const nlohmann::ordered_json& json) {
  print_out("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

/// Prints formatted text to standard error.
template <typename... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace tanglebin::cli
