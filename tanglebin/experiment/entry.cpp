#include "tanglebin/experiment/entry.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/files/read_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr const char* method_option = "--method";

bool is_blank(char character) {
  return character == ' ' || character == '\t' || character == '\n';
}

/// Splits a command into words.
class Words {
public:
  explicit Words(std::string_view text) : rest_(text) {}

  std::vector<std::string> all() {
    std::vector<std::string> words;
    while (true) {
      while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
      if (rest_.empty()) return words;
      words.push_back(word());
    }
  }

private:
  std::string word() {
    std::string word;
    while (!rest_.empty() && !is_blank(rest_.front())) {
      const char character = take();
      if (character == '\'' || character == '"') {
        add_quoted(character, word);
      } else {
        word += character == '\\' ? take() : character;
      }
    }
    return word;
  }

  void add_quoted(char quote, std::string& word) {
    for (char character = take(); character != quote; character = take()) {
      const bool is_escape = character == '\\' && quote == '"';
      word += is_escape ? take() : character;
    }
  }

  char take() {
    if (rest_.empty())
      throw InputError({"", 0, method_option}, "the end of the command", "a quote or a character");
    const char character = rest_.front();
    rest_.remove_prefix(1);
    return character;
  }

  std::string_view rest_;
};

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool is_program(const fs::path& path) {
  return is_file(path) && access(path.c_str(), X_OK) == 0;
}

// As execvp(3) finds it.
fs::path program_named(const std::string& name, const fs::path& directory) {
  std::vector<fs::path> folders;
  if (name.find('/') != std::string::npos) {
    folders.push_back(directory);
  } else if (const char* path = std::getenv("PATH")) {
    for (const std::string_view folder : split(path, ':')) folders.emplace_back(folder);
  }
  for (const fs::path& folder : folders) {
    if (is_program(folder / name)) return fs::absolute(folder / name).lexically_normal();
  }
  throw InputError({"", 0, method_option}, excerpt(name), "a program that is installed and may be run");
}

std::string sha256_of(const fs::path& file) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) throw InputError({file.string(), 0, ""}, "is missing");
  Sha256 hash;
  std::array<char, 1 << 16> block;
  while (in->read(block.data(), block.size()) || in->gcount() > 0)
    hash.add({block.data(), static_cast<std::size_t>(in->gcount())});
  expect_read(*in, file);
  return hash.hex();
}

bool has_placeholder(const Command& command, std::string_view start) {
  return std::ranges::any_of(placeholders(), [&](const Placeholder& placeholder) {
    const std::string in_braces = "{" + std::string(placeholder.name) + "}";
    return placeholder.name.starts_with(start) &&
           std::ranges::any_of(command.words, [&](const std::string& word) {
             return word.find(in_braces) != std::string::npos;
           });
  });
}

std::string option_of(const Entry& entry) {
  return std::holds_alternative<LabelsDirectory>(entry.what) ? "--labels" : method_option;
}

bool may_be_in_name(char character) {
  const bool is_letter = (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z');
  const bool is_digit = character >= '0' && character <= '9';
  return is_letter || is_digit || character == '-' || character == '_' || character == '.';
}

bool is_name(const std::string& name) {
  constexpr std::size_t longest = 60;
  return !name.empty() && name.size() <= longest && std::ranges::all_of(name, may_be_in_name) &&
         std::string_view("-_.").find(name.front()) == std::string_view::npos;
}

}  // namespace

bool is_built_in(const Entry& entry) {
  return std::holds_alternative<Method>(entry.what) || std::holds_alternative<BuiltIn>(entry.what);
}

Entry entry_of(Method method) {
  return {name_of(method), method};
}

std::vector<Entry> built_in_entries() {
  std::vector<Entry> entries;
  std::ranges::transform(methods(), std::back_inserter(entries), entry_of);
  return entries;
}

ProcessLimits default_limits() {
  constexpr std::chrono::minutes time{10};
  constexpr std::uint64_t disk = std::uint64_t{1} << 30U;
  return {.time = time, .disk = disk};
}

const std::vector<Placeholder>& placeholders() {
  static const std::vector<Placeholder> all = {
      {"cloud", "cloud.ply"}, {"cloud.ply", "cloud.ply"}, {"cloud.pcd", "cloud.pcd"}, {"out", "out.ply"},
      {"out.ply", "out.ply"}, {"out.pcd", "out.pcd"},     {"out.npy", "out.npy"},     {"out.txt", "out.txt"},
      {"tubes", "tubes.txt"}, {"scene", "scene.toml"}};
  return all;
}

Command command_of(const std::string& text, const fs::path& directory, const ProcessLimits& limits) {
  Command command{.text = text, .words = Words(text).all(), .limits = limits};
  if (!has_placeholder(command, "cloud"))
    throw InputError({"", 0, method_option}, excerpt(text), "{cloud}, the cloud to label, among its words");
  if (!has_placeholder(command, "out") && !has_placeholder(command, "tubes"))
    throw InputError({"", 0, method_option}, excerpt(text),
                     "{out} or {tubes}, the file to write, among its words");
  command.words.front() = program_named(command.words.front(), directory).string();
  for (std::string& word : command.words) {
    const fs::path path = fs::absolute(directory / word).lexically_normal();
    std::error_code ignored;  // a word that is no path
    if (word.empty() || !fs::exists(path, ignored)) continue;
    word = path.string();
    if (is_file(path)) command.sha256.emplace(word, sha256_of(path));
  }
  return command;
}

void expect_names(const std::vector<Entry>& entries) {
  std::set<std::string> names;
  for (const Entry& entry : entries) {
    const std::string option = option_of(entry);
    if (!is_name(entry.name))
      throw InputError({"", 0, option}, excerpt(entry.name), "a name of letters, digits, - _ and .");
    const bool is_reserved =
        std::ranges::any_of(methods(), [&](Method method) { return name_of(method) == entry.name; });
    if (is_reserved && !std::holds_alternative<Method>(entry.what))
      throw InputError({"", 0, option}, excerpt(entry.name), "another name than that of a built-in method");
    if (!names.insert(entry.name).second)
      throw InputError({"", 0, option}, entry.name + " twice", "each name once");
  }
}

}  // namespace tanglebin
