#include "tanglebin/base/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cstddef>

namespace tanglebin {
namespace {

bool is_shown(boost::locale::utf::code_point character) {
  const bool is_control = character < 0x20 || (character >= 0x7f && character < 0xa0);
  return !is_control && boost::locale::utf::is_valid_codepoint(character);
}

std::string escaped(char byte) {
  if (byte == '\n') return "\\n";
  if (byte == '\t') return "\\t";
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
}

}  // namespace

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, longest)) {
    const bool is_printable = c >= ' ' && c <= '~';
    shown += is_printable ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return shown + (text.size() > longest ? "…'" : "'");
}

std::string printable(std::string_view text) {
  namespace utf = boost::locale::utf;
  std::string shown;
  for (const char* place = text.begin(); place != text.end();) {
    const char* next = place;
    const utf::code_point character = utf::utf_traits<char>::decode(next, text.end());
    if (!utf::is_valid_codepoint(character)) next = place + 1;
    if (is_shown(character)) {
      shown.append(place, next);
    } else {
      for (; place != next; ++place) shown += escaped(*place);
    }
    place = next;
  }
  return shown;
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
