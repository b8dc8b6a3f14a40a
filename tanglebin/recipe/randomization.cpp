#include "tanglebin/recipe/randomization.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

constexpr std::array<std::string_view, 3> keys_of_ranges{"min", "max", "one_of"};

// The keys whose values are whole numbers, and are drawn as such.
constexpr std::array<std::string_view, 9> whole_keys{"width",         "height",         "sub_rays",
                                                     "iterations",    "iterations_max", "cylinders_min",
                                                     "cylinders_max", "from",           "to"};

// The other settings of a lens follow from these where they are not given.
constexpr std::array<std::string_view, 4> leading_lens_keys{"width", "height", "hfov_deg", "focal_length_px"};
constexpr std::array<std::string_view, 4> following_lens_keys{"fx", "fy", "cx", "cy"};
constexpr std::array<std::string_view, 4> pose_keys{"position", "rotation_wxyz", "rotation_matrix",
                                                    "look_at"};
// Of a lens or pose that is partly random, the fixed settings that the camera at its lowest does not tell.
constexpr std::array<std::string_view, 6> fixed_lens_keys{"hfov_deg", "focal_length_px", "fx", "fy", "cx",
                                                          "cy"};
constexpr std::array<std::string_view, 2> fixed_pose_keys{"rotation_wxyz", "look_at"};

bool holds(const auto& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

bool is_random(const toml::node& node) {
  const toml::table* table = node.as_table();
  return table != nullptr && table->is_inline() &&
         std::ranges::any_of(keys_of_ranges, [&](std::string_view key) { return table->contains(key); });
}

/// Is it a random number or an array with one?
bool holds_random(const toml::node& node) {
  if (is_random(node)) return true;
  const toml::array* array = node.as_array();
  return array != nullptr && std::any_of(array->begin(), array->end(),
                                         [](const toml::node& element) { return holds_random(element); });
}

// Reading

/// A random number's table, for messages.
struct Range {
  const std::string& path;
  const toml::table& table;
  const TomlSource& source;

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError({source.file(), source.line(path), path}, found, expected);
  }
};

double finite_number(const toml::node& node, const Range& range) {
  const auto value = node.value<double>();
  const bool valid = value && std::isfinite(*value) && (node.is_integer() || !is_whole(range.path));
  if (!valid) range.fail(description(node), is_whole(range.path) ? "whole numbers" : "finite numbers");
  return *value;
}

RandomNumber read_limits(const Range& range) {
  if (!range.table.contains("min") || !range.table.contains("max") || range.table.size() != 2) {
    range.fail("a table", "{ min = NUMBER, max = NUMBER } or { one_of = [NUMBERS] }");
  }
  RandomNumber number;
  number.min = finite_number(*range.table.get("min"), range);
  number.max = finite_number(*range.table.get("max"), range);
  if (!(number.min <= number.max)) {
    range.fail(fmt::format("min = {} and max = {}", number.min, number.max), "min to be at most max");
  }
  return number;
}

RandomNumber read_list(const Range& range) {
  const toml::array* values = range.table.get("one_of")->as_array();
  if (values == nullptr || values->empty() || range.table.size() != 1) {
    range.fail("a table", "{ one_of = [NUMBERS] } with at least one number");
  }
  RandomNumber number;
  number.one_of.reserve(values->size());
  for (const toml::node& value : *values) number.one_of.push_back(finite_number(value, range));
  return number;
}

RandomNumber read_random_number(const Range& range) {
  return range.table.contains("one_of") ? read_list(range) : read_limits(range);
}

// Settings

// All numbers of a node, fixed or random.
void add_settings_of(const toml::node& node, const std::string& path, std::vector<RandomSetting>& settings) {
  for_each_node(node, path, [&](const std::string& place, const toml::node& value) {
    if (is_random(value)) {
      settings.push_back({place, read_random_number({place, *value.as_table(), {}})});
      return false;
    }
    if (value.is_number()) settings.push_back({place, *value.value<double>()});
    return true;
  });
}

void add_settings(const toml::table& table, const std::string& path, std::vector<RandomSetting>& settings) {
  const auto any_random_of = [&](const auto& keys) {
    return path.starts_with("scanner") && std::ranges::any_of(keys, [&](std::string_view key) {
             const toml::node* node = table.get(key);
             return node != nullptr && holds_random(*node);
           });
  };
  const bool lens = any_random_of(leading_lens_keys);
  const bool pose = any_random_of(pose_keys);
  for (const auto& [key, node] : table) {
    const bool goes_with =
        (lens && holds(fixed_lens_keys, key.str())) || (pose && holds(fixed_pose_keys, key.str()));
    if (goes_with || holds_random(node)) add_settings_of(node, path_of(path, key.str()), settings);
  }
}

void replace_prefix(std::string& text, const std::string& prefix, const std::string& replacement) {
  if (text.starts_with(prefix)) text.replace(0, prefix.size(), replacement);
}

// A set's only kind of tubes, and a tube's only segment, are written without an array around them.
std::string written_path(std::string path, const Recipe& recipe) {
  for (std::size_t i = 0; i < recipe.sets.size(); ++i) {
    const std::vector<TubeSpec>& kinds = recipe.sets[i].kinds;
    const std::string tube = fmt::format("set[{}].tube", i);
    if (kinds.size() == 1) replace_prefix(path, tube + "[0].", tube + ".");
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::string kind = kinds.size() == 1 ? tube : fmt::format("{}[{}]", tube, k);
      if (kinds[k].segments.size() == 1) replace_prefix(path, kind + ".segment[0].", kind + ".");
    }
  }
  return path;
}

// The nodes of a tube's only segment, which must be 1 and 2, are not written.
bool is_written(const RandomSetting& setting) {
  const std::string_view key = key_in(setting.path);
  const bool is_end = key == "from" || key == "to";
  return !is_end || table_in(setting.path).find(".segment[") != std::string_view::npos;
}

// Writing

/// Calls `put` with the number as TOML has it. One that is not whole where it must be is an error of the
/// reader's.
template <typename Put>
void put_number(double number, bool whole, const Put& put) {
  constexpr double most = 1LL << 53;
  if (whole && std::trunc(number) == number && std::abs(number) <= most) {
    put(static_cast<std::int64_t>(number));
  } else {
    put(number);
  }
}

toml::table random_table(const RandomNumber& number, bool whole) {
  toml::table table;
  table.is_inline(true);
  if (number.one_of.empty()) {
    put_number(number.min, whole, [&](auto value) { table.insert("min", value); });
    put_number(number.max, whole, [&](auto value) { table.insert("max", value); });
    return table;
  }
  toml::array values;
  for (const double choice : number.one_of)
    put_number(choice, whole, [&](auto value) { values.push_back(value); });
  table.insert("one_of", std::move(values));
  return table;
}

toml::table& table_of(toml::table& tree, const RandomSetting& setting) {
  toml::table* table = toml::at_path(tree, table_in(setting.path)).as_table();
  if (table == nullptr) throw InputError({"", 0, setting.path}, "no table of the recipe");
  return *table;
}

// Removes what a setting says, perhaps in another way.
void make_way(toml::table& table, std::string_view key) {
  table.erase(key);
  if (holds(leading_lens_keys, key)) {
    for (const std::string_view other : following_lens_keys) table.erase(other);
  }
  if (key == "rotation_wxyz" || key == "look_at") table.erase("rotation_matrix");
}

/// Puts a value under its key or, the elements of an array coming in order, at the array's end.
template <typename Value>
void put_value(toml::table& table, std::string_view path, Value value) {
  const std::string_view key = key_in(path);
  const std::string_view index = path.substr(table_in(path).size() + 1 + key.size());
  if (index.empty()) {
    table.insert_or_assign(key, std::move(value));
    return;
  }
  if (!table.contains(key)) table.insert(key, toml::array{});
  toml::array* array = table.get(key)->as_array();
  const bool is_in_matrix = index.find('[', 1) != std::string_view::npos;
  if (is_in_matrix) {
    if (array->empty() || index.ends_with("[0]")) array->push_back(toml::array{});
    array = array->back().as_array();
  }
  array->push_back(std::move(value));
}

void put_setting(toml::table& table, const RandomSetting& setting) {
  const auto put = [&](auto value) { put_value(table, setting.path, std::move(value)); };
  const bool whole = is_whole(setting.path);
  if (const RandomNumber* number = std::get_if<RandomNumber>(&setting.value)) {
    put(random_table(*number, whole));
  } else {
    put_number(std::get<double>(setting.value), whole, put);
  }
}

// Drawing

void replace_random(toml::node& node, const std::string& path, const NumbersByPath& numbers) {
  const auto replace = [&](toml::node& inner, const std::string& place, const auto& put) {
    if (is_random(inner)) {
      put_number(numbers.at(place), is_whole(place), put);
    } else {
      replace_random(inner, place, numbers);
    }
  };
  if (toml::table* table = node.as_table()) {
    for (auto&& [key, value] : *table) {
      const std::string_view name = key.str();
      replace(value, path_of(path, name), [&](auto number) { table->insert_or_assign(name, number); });
    }
  }
  if (toml::array* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      const auto at = array->cbegin() + static_cast<std::ptrdiff_t>(i);
      replace((*array)[i], fmt::format("{}[{}]", path, i), [&](auto number) { array->replace(at, number); });
    }
  }
}

}  // namespace

std::string_view table_in(std::string_view path) {
  const std::size_t last = path.rfind('.');
  return last == std::string_view::npos ? std::string_view{} : path.substr(0, last);
}

std::string_view key_in(std::string_view path) {
  const std::string_view table = table_in(path);
  const std::string_view place = table.empty() ? path : path.substr(table.size() + 1);
  return place.substr(0, place.find('['));
}

bool is_whole(std::string_view path) {
  return !table_in(path).empty() && holds(whole_keys, key_in(path)) &&
         !path.starts_with("bin.");  // "bin.height" is a length
}

std::vector<PlacedNumber> find_random_numbers(const toml::table& tree, const TomlSource& source) {
  std::vector<std::pair<toml::source_position, PlacedNumber>> found;
  for_each_node(tree, "", [&](const std::string& path, const toml::node& node) {
    if (!is_random(node)) return true;
    found.emplace_back(node.source().begin,
                       PlacedNumber{path, read_random_number({path, *node.as_table(), source})});
    return false;
  });
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlacedNumber> numbers;
  numbers.reserve(found.size());
  for (auto& [position, number] : found) numbers.push_back(std::move(number));
  return numbers;
}

toml::table with_numbers(const toml::table& tree, const NumbersByPath& numbers) {
  toml::table drawn = tree;
  replace_random(drawn, "", numbers);
  return drawn;
}

std::vector<double> numbers_to_try(const RandomNumber& number) {
  return number.one_of.empty() ? std::vector{number.min, number.max} : number.one_of;
}

double lowest(const RandomNumber& number) {
  return std::ranges::min(numbers_to_try(number));
}

double highest(const RandomNumber& number) {
  return std::ranges::max(numbers_to_try(number));
}

std::vector<RandomSetting> random_settings(const toml::table& tree, const Recipe& recipe) {
  std::vector<RandomSetting> settings;
  for_each_node(tree, "", [&](const std::string& path, const toml::node& node) {
    if (is_random(node)) return false;
    if (node.is_table()) add_settings(*node.as_table(), path, settings);
    return true;
  });
  for (RandomSetting& setting : settings) setting.path = written_path(setting.path, recipe);
  std::erase_if(settings, [](const RandomSetting& setting) { return !is_written(setting); });
  return settings;
}

void put_settings(toml::table& tree, const std::vector<RandomSetting>& settings) {
  for (const RandomSetting& setting : settings) make_way(table_of(tree, setting), key_in(setting.path));
  for (const RandomSetting& setting : settings) put_setting(table_of(tree, setting), setting);
}

}  // namespace tanglebin
