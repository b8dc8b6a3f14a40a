#include "tanglebin/recipe/randomization.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

// The keys whose values are whole numbers, and are drawn as such.
constexpr std::array<std::string_view, 12> whole_keys{
    "tubes",      "width",          "height",        "sub_rays",      "fill", "median",
    "iterations", "iterations_max", "cylinders_min", "cylinders_max", "from", "to"};

// The other settings of a lens follow from these where they are not given.
constexpr std::array<std::string_view, 4> leading_lens_keys{"width", "height", "hfov_deg", "focal_length_px"};
constexpr std::array<std::string_view, 4> following_lens_keys{"fx", "fy", "cx", "cy"};
constexpr std::array<std::string_view, 7> pose_keys{"position", "rotation_wxyz", "rotation_matrix", "look_at",
                                                    "distance", "tilt_deg",      "azimuth_deg"};
// Of a lens or pose that is partly random, the fixed settings that the camera at its lowest does not tell.
constexpr std::array<std::string_view, 6> fixed_lens_keys{"hfov_deg", "focal_length_px", "fx", "fy", "cx",
                                                          "cy"};
constexpr std::array<std::string_view, 5> fixed_pose_keys{"rotation_wxyz", "look_at", "distance", "tilt_deg",
                                                          "azimuth_deg"};

bool holds(const auto& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

bool is_random(const toml::node& node) {
  const toml::table* table = node.as_table();
  return table != nullptr && table->is_inline() &&
         std::ranges::any_of(keys_of_random_numbers,
                             [&](std::string_view key) { return table->contains(key); });
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

  bool has(std::string_view key) const { return table.contains(key); }

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError({source.file(), source.line(path), path}, found, expected);
  }

  /// Throws unless the table has all these keys and, besides, only optional ones.
  void expect_keys(const std::vector<std::string_view>& required,
                   const std::vector<std::string_view>& optional) const {
    constexpr const char* forms =
        "{ min = NUMBER, max = NUMBER }, { mean = NUMBER, sigma = NUMBER } or { one_of = [NUMBERS] }";
    for (const std::string_view key : required)
      if (!has(key)) fail(fmt::format("a table without {}", key), forms);
    for (const auto& [key, value] : table)
      if (!holds(required, key.str()) && !holds(optional, key.str()))
        fail(fmt::format("a table with {}", excerpt(key.str())), forms);
  }
};

double finite_number(const toml::node& node, const Range& range) {
  const auto value = node.value<double>();
  const bool valid = value && std::isfinite(*value) && (node.is_integer() || !is_whole(range.path));
  if (!valid) range.fail(description(node), is_whole(range.path) ? "whole numbers" : "finite numbers");
  return *value;
}

double any_finite_number(const toml::node& node, const Range& range) {
  const auto value = node.value<double>();
  if (!value || !std::isfinite(*value)) range.fail(description(node), "finite numbers");
  return *value;
}

RandomNumber read_limits(const Range& range) {
  range.expect_keys({"min", "max"}, {"per"});
  RandomNumber number;
  number.min = finite_number(*range.table.get("min"), range);
  number.max = finite_number(*range.table.get("max"), range);
  if (!(number.min <= number.max)) {
    range.fail(fmt::format("min = {} and max = {}", number.min, number.max), "min to be at most max");
  }
  return number;
}

// An end that is not given is so far from the mean that hardly a number is beyond it.
constexpr double sigmas_to_an_end = 4;
// With closer ends, most numbers would be rejected.
constexpr double least_sigmas_between_ends = 0.1;

RandomNumber read_normal(const Range& range) {
  range.expect_keys({"mean", "sigma"}, {"min", "max", "per"});
  RandomNumber number;
  number.mean = any_finite_number(*range.table.get("mean"), range);
  number.sigma = any_finite_number(*range.table.get("sigma"), range);
  if (!(number.sigma > 0)) range.fail(fmt::format("sigma = {}", number.sigma), "a positive sigma");
  const double reach = sigmas_to_an_end * number.sigma;
  const bool whole = is_whole(range.path);
  number.min = whole ? std::floor(number.mean - reach) : number.mean - reach;
  number.max = whole ? std::ceil(number.mean + reach) : number.mean + reach;
  if (const toml::node* min = range.table.get("min")) number.min = finite_number(*min, range);
  if (const toml::node* max = range.table.get("max")) number.max = finite_number(*max, range);
  const bool is_mean_inside = number.min <= number.mean && number.mean <= number.max;
  if (!is_mean_inside || number.max - number.min < least_sigmas_between_ends * number.sigma) {
    range.fail(fmt::format("min = {:.6g} and max = {:.6g}", number.min, number.max),
               fmt::format("the mean, {:.6g}, between ends a tenth of sigma or more apart", number.mean));
  }
  return number;
}

RandomNumber read_list(const Range& range) {
  range.expect_keys({"one_of"}, {"per"});
  const toml::array* values = range.table.get("one_of")->as_array();
  if (values == nullptr || values->empty()) {
    range.fail("a table", "{ one_of = [NUMBERS] } with at least one number");
  }
  // The recipe is read again with each of them.
  constexpr std::size_t most_values = 1000;
  if (values->size() > most_values)
    range.fail(fmt::format("one_of with {} numbers", values->size()), fmt::format("at most {}", most_values));
  RandomNumber number;
  number.one_of.reserve(values->size());
  for (const toml::node& value : *values) number.one_of.push_back(finite_number(value, range));
  return number;
}

// Does each case of a set draw its number of tubes from a node with this path? Such a node is no setting: it
// decides which cases there are.
bool is_number_of_tubes(std::string_view path) {
  return path.starts_with("set[") && path.ends_with("].tubes");
}

bool is_of_a_tube(std::string_view path) {
  return path.starts_with("set[") &&
         (path.find("].tube.") != std::string_view::npos || path.find("].tube[") != std::string_view::npos);
}

bool read_per_tube(const Range& range) {
  const toml::node* per = range.table.get("per");
  if (per == nullptr) return false;
  const auto name = per->value<std::string_view>();
  if (name != "scene" && name != "tube")
    range.fail(fmt::format("per = {}", description(*per)), "per = \"scene\" or \"tube\"");
  if (name == "tube" && !is_of_a_tube(range.path))
    range.fail("per = 'tube'", "per = \"scene\", because this number is not a tube's");
  return name == "tube";
}

RandomNumber read_number(const Range& range) {
  const auto read = [&] {
    if (range.has("one_of")) return read_list(range);
    return range.has("mean") || range.has("sigma") ? read_normal(range) : read_limits(range);
  };
  RandomNumber number = read();
  number.per_tube = read_per_tube(range);
  return number;
}

// Settings

// All numbers of a node, fixed or random.
void add_settings_of(const toml::node& node, const std::string& path, std::vector<RandomSetting>& settings) {
  for_each_node(node, path, [&](const std::string& place, const toml::node& value) {
    if (is_random(value)) {
      settings.push_back({place, read_random_number(*value.as_table(), place, {})});
      return false;
    }
    if (const auto* real = value.as_floating_point()) settings.push_back({place, real->get()});
    if (const auto* integer = value.as_integer()) {
      settings.push_back({place, static_cast<double>(integer->get())});
    }
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
    const bool is_setting = !is_number_of_tubes(path_of(path, key.str()));
    if (goes_with || (is_setting && holds_random(node)))
      add_settings_of(node, path_of(path, key.str()), settings);
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
  if (key == "distance") table.erase("position");
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
    if (const auto number = numbers.find(place); number != numbers.end()) {
      put_number(number->second, is_whole(place), put);
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

RandomNumber read_random_number(const toml::table& table, const std::string& path, const TomlSource& source) {
  return read_number({path, table, source});
}

toml::table random_table(const RandomNumber& number, bool whole) {
  toml::table table;
  table.is_inline(true);
  if (number.per_tube) table.insert("per", "tube");
  if (number.sigma > 0) {
    table.insert("mean", number.mean);
    table.insert("sigma", number.sigma);
  }
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

std::vector<PlacedNumber> find_random_numbers(const toml::table& tree, const TomlSource& source) {
  std::vector<std::pair<toml::source_position, PlacedNumber>> found;
  for_each_node(tree, "", [&](const std::string& path, const toml::node& node) {
    if (!is_random(node)) return true;
    if (is_number_of_tubes(path)) return false;
    found.emplace_back(node.source().begin,
                       PlacedNumber{path, read_random_number(*node.as_table(), path, source)});
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

double middle(const RandomNumber& number, bool whole) {
  if (!number.one_of.empty()) {
    std::vector<double> values = number.one_of;
    std::ranges::sort(values);
    return values[(values.size() - 1) / 2];
  }
  const double value = number.sigma > 0 ? number.mean : std::midpoint(number.min, number.max);
  return whole ? std::clamp(std::round(value), number.min, number.max) : value;
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
