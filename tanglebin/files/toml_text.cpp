#include "tanglebin/files/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr std::size_t most_levels = 64;

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 128;
}

// With '?' for other bytes.
std::string ascii(std::string_view text) {
  std::string result(text);
  std::ranges::replace_if(
      result, [](char c) { return !is_ascii(c); }, '?');
  return result;
}

// Takes the first character from a text; none if it is not UTF-8.
std::optional<std::uint32_t> take_character(std::string_view& text) {
  namespace utf = boost::locale::utf;
  const char* next = text.begin();
  const utf::code_point character = utf::utf_traits<char>::decode(next, text.end());
  if (!utf::is_valid_codepoint(character)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(next - text.begin()));
  return character;
}

// A character of a basic string.
std::string escaped(std::uint32_t character) {
  return character < 128 ? std::string(1, static_cast<char>(character)) : fmt::format("\\U{:08x}", character);
}

// No escape has a character that is not ASCII, nor '?'.
std::string after_backslash(std::uint32_t character) {
  return character < 128 ? std::string(1, static_cast<char>(character)) : "?";
}

// A character of a literal string, in a basic one.
std::string escaped_in_literal(std::uint32_t character) {
  const bool has_meaning = character == '"' || character == '\\';
  return (has_meaning ? "\\" : "") + escaped(character);
}

// Goes through a text. Where it is not TOML, toml++ stops, and what comes later does not matter.
class TomlText {
public:
  TomlText(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  std::string checked() && {
    while (place_ < text_.size()) check_next();
    return std::move(checked_);
  }

private:
  void check_next() {
    switch (text_[place_]) {
      case '#':
        return copy_comment();
      case '"':
      case '\'':
        return copy_string();
      case '[':
      case '{':
        open();
        break;
      case ']':
      case '}':
        close();
        break;
      case '.':
        deepen();
        break;
      case ',':
        levels_ = levels_around();
        break;
      case '\n':
        end_line();
        break;
      default:
        expect_ascii();
    }
    checked_ += text_[place_++];
  }

  // toml++ 3.3 rejects a comment that is not UTF-8.
  void copy_comment() {
    const std::size_t end = std::min(text_.find('\n', place_), text_.size());
    checked_ += ascii(std::string_view(text_).substr(place_, end - place_));
    place_ = end;
  }

  void copy_string() {
    const char quote = text_[place_];
    const std::size_t begin = place_;
    const std::size_t quotes = is_at(std::string(3, quote)) ? 3 : 1;
    const bool is_whole = skip_string(std::string(quotes, quote));
    const std::string_view string = std::string_view(text_).substr(begin, place_ - begin);
    if (!is_whole || std::ranges::all_of(string, is_ascii)) {
      checked_ += ascii(string);
      return;
    }
    const std::string end(quotes, '"');
    const std::string_view body = string.substr(quotes, string.size() - 2 * quotes);
    checked_ += end + (quote == '"' ? escaped_basic(body) : escaped_literal(body)) + end;
  }

  // Returns whether the string ends.
  bool skip_string(const std::string& end) {
    const bool has_lines = end.size() > 1;
    for (place_ += end.size(); place_ < text_.size() && !is_at(end); ++place_) {
      if (!has_lines && text_[place_] == '\n') return false;
      if (end[0] == '"' && text_[place_] == '\\') ++place_;
    }
    const bool is_whole = place_ < text_.size();
    place_ = std::min(place_ + end.size(), text_.size());
    // Before the three quotation marks that end a string, there may be two that belong to it.
    for (int i = 0; i < 2 && has_lines && is_at(end.substr(0, 1)); ++i) ++place_;
    return is_whole;
  }

  std::string escaped_basic(std::string_view body) const {
    std::string result;
    bool follows_backslash = false;
    for_each_character(body, [&](std::uint32_t character) {
      result += follows_backslash ? after_backslash(character) : escaped(character);
      follows_backslash = character == '\\' && !follows_backslash;
    });
    return result;
  }

  std::string escaped_literal(std::string_view body) const {
    std::string result;
    for_each_character(body, [&](std::uint32_t character) { result += escaped_in_literal(character); });
    return result;
  }

  void for_each_character(std::string_view body, const auto& visit) const {
    for (std::string_view rest = body; !rest.empty();) {
      const std::optional<std::uint32_t> character = take_character(rest);
      if (!character) throw InputError(place(), excerpt(body), "UTF-8");
      visit(*character);
    }
  }

  void open() {
    if (enclosing_.empty() && begins_line()) {
      is_header_ = true;
      levels_ = header_ = 0;
    }
    enclosing_.push_back(levels_);
    deepen();
  }

  void close() {
    if (enclosing_.empty()) return;
    levels_ = enclosing_.back();
    enclosing_.pop_back();
  }

  void deepen() {
    ++levels_;
    if (is_header_) header_ = std::max(header_, levels_);
    if (levels_ > most_levels)
      throw InputError(place(), "TOML nested too deep", fmt::format("at most {} levels", most_levels));
  }

  void end_line() {
    if (!enclosing_.empty()) return;
    is_header_ = false;
    levels_ = header_;
  }

  void expect_ascii() const {
    if (!is_ascii(text_[place_]))
      throw InputError(place(), excerpt(word()), "ASCII, except in strings and comments");
  }

  // Of brackets around a key or value, or else of the header above it.
  std::size_t levels_around() const { return enclosing_.empty() ? header_ : enclosing_.back() + 1; }

  bool is_at(std::string_view what) const {
    return place_ < text_.size() && text_.compare(place_, what.size(), what) == 0;
  }

  bool begins_line() const {
    const std::size_t before = std::string_view(text_).substr(0, place_).find_last_not_of(" \t");
    return before == std::string::npos || text_[before] == '\n';
  }

  // What is between separators around the place.
  std::string_view word() const {
    constexpr std::string_view separators = " \t\r\n=.,[]{}#\"'";
    const std::string_view text = text_;
    const std::size_t begin = text.substr(0, place_).find_last_of(separators) + 1;
    return text.substr(begin, text.find_first_of(separators, place_) - begin);
  }

  InputPlace place() const {
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(place_), '\n');
    return {name_, static_cast<std::size_t>(lines) + 1, ""};
  }

  const std::string& text_;
  const std::string& name_;
  std::string checked_;
  std::size_t place_ = 0;
  std::size_t levels_ = 0;              // of brackets and dots at the place
  std::size_t header_ = 0;              // of the latest table's header
  bool is_header_ = false;              // is the place in a header?
  std::vector<std::size_t> enclosing_;  // the levels at each bracket that is open
};

}  // namespace

std::string checked_toml(const std::string& text, const std::string& name) {
  return TomlText(text, name).checked();
}

}  // namespace tanglebin
