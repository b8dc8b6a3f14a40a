#include "tanglebin/base/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

namespace tanglebin {

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, longest)) {
    const bool is_printable = c >= ' ' && c <= '~';
    shown += is_printable ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return shown + (text.size() > longest ? "…'" : "'");
}

void words_of(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  const auto is_space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  auto begin = std::ranges::find_if_not(line, is_space);
  while (begin != line.end()) {
    const auto end = std::find_if(begin, line.end(), is_space);
    words.emplace_back(begin, end);
    begin = std::find_if_not(end, line.end(), is_space);
  }
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  words_of(line, words);
  return words;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

}  // namespace tanglebin
