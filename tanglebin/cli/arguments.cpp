#include "tanglebin/cli/arguments.hpp"

#include <charconv>
#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin::cli {
namespace {

std::optional<int> parse_positive(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

// The two numbers around a separator.
std::optional<std::pair<int, int>> parse_pair(std::string_view text, char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto first = parse_positive(text.substr(0, middle));
  const auto second = parse_positive(text.substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

std::string quoted(std::string_view text) {
  return '"' + std::string(text) + '"';
}

}  // namespace

void write_output(const std::string& file, std::string_view bytes) {
  if (file != standard_stream) {
    write_file(file, bytes);
    return;
  }
  std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  if (!std::cout) throw InputError({"standard output", 0, ""}, "cannot be written");
}

Range parse_range(std::string_view text, const std::string& option) {
  if (const auto one = parse_positive(text)) return {*one, *one};
  const auto two = parse_pair(text, '-');
  if (!two || two->first > two->second) {
    throw InputError({"", 0, option}, quoted(text), "a number or a range such as 1-20");
  }
  return {two->first, two->second};
}

Shard parse_shard(std::string_view text, const std::string& option) {
  const auto parts = parse_pair(text, '/');
  if (!parts || parts->first > parts->second) {
    throw InputError({"", 0, option}, quoted(text), "a part I/N such as 2/8, I from 1 to N");
  }
  return {parts->first, parts->second};
}

}  // namespace tanglebin::cli
