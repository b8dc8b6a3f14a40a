#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

// The words that stand for themselves in TOML.
constexpr std::array<std::string_view, 4> toml_words{"true", "false", "inf", "nan"};

// A setting from the command line, key=value, where a string needs no quotation marks.
std::string toml_line(const std::string& setting) {
  const std::size_t middle = setting.find('=');
  if (middle == std::string::npos || middle + 1 == setting.size()) return setting;
  const std::string value = setting.substr(middle + 1);
  const bool begins_with_letter =
      (value[0] >= 'a' && value[0] <= 'z') || (value[0] >= 'A' && value[0] <= 'Z');
  const bool is_string = begins_with_letter && std::ranges::find(toml_words, value) == toml_words.end();
  return is_string ? fmt::format("{} = {:?}", setting.substr(0, middle), value) : setting;
}

std::string text_of(const std::vector<std::string>& settings, const std::string& option) {
  std::string text;
  for (const std::string& setting : settings) {
    if (setting.find('=') == std::string::npos)
      throw InputError({"", 0, option}, excerpt(setting), "NAME=VALUE, such as scanner.baseline=0.3");
    text += toml_line(setting) + '\n';
  }
  return text;
}

// What `read` makes of the [scanner] in a text.
template <typename Read>
Scanner scanner_of_text(const std::string& text, const std::string& name, const Read& read) {
  const toml::table tree = parse_toml(text, name);
  const TomlSource source(name, tree);
  const TomlTable table(source, tree, "");
  table.allow({"scanner"});
  Scanner scanner = read(table.table("scanner"));
  validate_at(source, [&] {
    validate(scanner.camera);
    validate(scanner.sensor);
  });
  return scanner;
}

// The same of settings from the command line, which are in no file and so on no line.
template <typename Read>
Scanner scanner_from(const std::string& text, const std::string& option, const Read& read) {
  try {
    return scanner_of_text(text, option, read);
  } catch (const InputError& error) {
    throw InputError({option, 0, error.place().field}, error.problem());
  }
}

// Recipes

// Before anything else: a later format may have other keys.
void expect_known_format(const TomlTable& root) {
  std::uint64_t format = recipe_format;
  root.get("format", format);
  if (format < 1) root.fail("format", fmt::format("{}", format), "at least 1");
  if (format > recipe_format)
    throw InputError({root.file(), root.line("format"), ""},
                     fmt::format("this recipe's format is {}; this version of Tanglebin reads up to {}",
                                 format, recipe_format));
}

// Which cases there are, and what they follow from, is not random.
void expect_drawable(const std::string& path, const TomlSource& source) {
  const bool structural = path == "seed" || path == "attempts" || path.ends_with(".cases") ||
                          path.ends_with(".weight") || path.find(".tubes") != std::string::npos;
  if (structural)
    throw InputError({source.file(), source.line(path), path}, "a random number", "a fixed one");
}

// Without one of these, the resolved recipe could not say what the field of view of another size is.
void expect_lens_of_random_size(const std::vector<RandomSetting>& settings, const TomlSource& source) {
  const auto has = [&](std::string_view table, std::string_view key) {
    return std::ranges::find(settings, path_of(table, key), &RandomSetting::path) != settings.end();
  };
  for (const RandomSetting& setting : settings) {
    const std::string_view table = table_in(setting.path);
    const std::string_view key = key_in(setting.path);
    if (!table.starts_with("scanner") || (key != "width" && key != "height")) continue;
    if (has(table, "hfov_deg") || has(table, "focal_length_px") || has(table, "fx")) continue;
    throw InputError({source.file(), source.line(setting.path), setting.path}, "a random image size",
                     "hfov_deg, focal_length_px, or fx and fy beside it");
  }
}

// Reads the recipe with the lowest and with the highest numbers, and with each alone at either end of its
// range or at any number of its list.
Recipe read_random(const toml::table& tree, const std::vector<PlacedNumber>& numbers,
                   const TomlSource& source) {
  NumbersByPath lows;
  NumbersByPath highs;
  for (const auto& [path, number] : numbers) {
    expect_drawable(path, source);
    lows[path] = lowest(number);
    highs[path] = highest(number);
  }
  read_tree(with_numbers(tree, highs), source);
  for (const auto& [path, number] : numbers) {
    NumbersByPath one_other = lows;
    for (const double value : numbers_to_try(number)) {
      one_other[path] = value;
      read_tree(with_numbers(tree, one_other), source);
    }
  }
  Recipe recipe = read_tree(with_numbers(tree, lows), source);
  recipe.random = random_settings(tree, recipe);
  expect_lens_of_random_size(recipe.random, source);
  sort_as_written(recipe);
  return recipe;
}

}  // namespace

Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option) {
  const std::string of_preset = fmt::format("scanner.preset = {:?}\n", preset);
  return scanner_from(text_of(settings, option) + of_preset, option, read_single_scanner);
}

Scanner scanner_with(const Scanner& scanner, const std::vector<std::string>& settings,
                     const std::string& option) {
  return scanner_from(text_of(settings, option), option, [&](const TomlTable& table) {
    table.allow(scanner_setting_keys());
    return with_settings(scanner, table);
  });
}

Recipe read_recipe(std::istream& in, const std::string& name) {
  const std::string text = read_bytes(in, name);
  if (in.bad()) throw InputError({name, 0, ""}, "cannot be read");
  toml::table tree = parse_toml(text, name);
  TomlSource source(name, tree);
  expect_known_format({source, tree, ""});
  inherit_tube(tree, source);
  const std::vector<PlacedNumber> numbers = find_random_numbers(tree, source);
  return numbers.empty() ? read_tree(tree, source) : read_random(tree, numbers, source);
}

Recipe read_recipe(const std::filesystem::path& file) {
  std::ifstream in = open_input(file);
  return read_recipe(in, file.string());
}

}  // namespace tanglebin
