#include "tanglebin/base/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cstddef>

namespace tanglebin {
namespace {

// A character, or else a byte that is not UTF-8.
struct Character {
  std::string_view bytes;
  bool is_printable;
};

Character first_character(std::string_view text) {
  namespace utf = boost::locale::utf;
  const char* next = text.begin();
  const utf::code_point code = utf::utf_traits<char>::decode(next, text.end());
  if (!utf::is_valid_codepoint(code)) return {text.substr(0, 1), false};
  const bool is_control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  return {text.substr(0, static_cast<std::size_t>(next - text.begin())), !is_control};
}

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  return text;
}

std::string escaped(std::string_view bytes) {
  if (bytes == "\n") return "\\n";
  if (bytes == "\t") return "\\t";
  return hexadecimal(bytes);
}

}  // namespace

std::string excerpt(std::string_view text) {
  constexpr int longest = 40;
  std::string shown = "'";
  for (int i = 0; i < longest && !text.empty(); ++i) {
    const auto [bytes, is_printable] = first_character(text);
    shown += is_printable ? std::string(bytes) : hexadecimal(bytes);
    text.remove_prefix(bytes.size());
  }
  return shown + (text.empty() ? "'" : "…'");
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto [bytes, is_printable] = first_character(text);
    shown += is_printable ? std::string(bytes) : escaped(bytes);
    text.remove_prefix(bytes.size());
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
