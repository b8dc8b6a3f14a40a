#include "tanglebin/recipe/randomization.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

constexpr std::array<std::string_view, 3> keys_of_ranges{"min", "max", "one_of"};

// The keys whose values are whole numbers, and are drawn as such.
constexpr std::array<std::string_view, 9> whole_keys{"width",         "height",         "sub_rays",
                                                     "iterations",    "iterations_max", "cylinders_min",
                                                     "cylinders_max", "from",           "to"};

constexpr std::array<std::string_view, 8> lens_keys{"width", "height", "hfov_deg", "focal_length_px",
                                                    "fx",    "fy",     "cx",       "cy"};
// Of these, the ones that the others follow from where they are not said.
constexpr std::array<std::string_view, 4> leading_lens_keys{"width", "height", "hfov_deg", "focal_length_px"};
constexpr std::array<std::string_view, 4> pose_keys{"position", "rotation_wxyz", "rotation_matrix",
                                                    "look_at"};

bool holds(const auto& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

bool is_random(const toml::node& node) {
  const toml::table* table = node.as_table();
  return table != nullptr && table->is_inline() &&
         std::ranges::any_of(keys_of_ranges, [&](std::string_view key) { return table->contains(key); });
}

/// Is it, or has it in an array, a number to be drawn?
bool holds_random(const toml::node& node) {
  if (is_random(node)) return true;
  const toml::array* array = node.as_array();
  return array != nullptr && std::any_of(array->begin(), array->end(),
                                         [](const toml::node& element) { return holds_random(element); });
}

std::string path_of(const std::string& table, std::string_view key) {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

/// Calls visit(path, node) for all that is in a table, inner tables and arrays too, but not for what is in a
/// number to be drawn.
void for_each_node(const toml::node& node, const std::string& path,
                   const std::function<void(const std::string&, const toml::node&)>& visit) {
  visit(path, node);
  if (is_random(node)) return;
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) for_each_node(value, path_of(path, key.str()), visit);
  }
  if (const toml::array* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      for_each_node((*array)[i], fmt::format("{}[{}]", path, i), visit);
    }
  }
}

std::size_t offset_of(const std::string& text, const toml::source_position& position) {
  std::size_t line_begin = 0;
  for (toml::source_index line = 1; line < position.line; ++line)
    line_begin = text.find('\n', line_begin) + 1;
  return line_begin + position.column - 1;
}

// "bin.height" is a length.
bool is_whole(std::string_view path) {
  const std::size_t last = path.rfind('.');
  return last != std::string_view::npos && holds(whole_keys, path.substr(last + 1)) &&
         !path.starts_with("bin.");
}

[[noreturn]] void fail(const RandomNumber& number, const std::string& file, const std::string& found,
                       const std::string& expected) {
  throw InputError({file, number.line, number.path}, found, expected);
}

double finite_number(const toml::node& node, const RandomNumber& number, const std::string& file) {
  const auto value = node.value<double>();
  if (!value || !std::isfinite(*value)) fail(number, file, "what is no number", "finite numbers");
  if (number.integer && !node.is_integer()) fail(number, file, real_text(*value), "whole numbers");
  return *value;
}

void read_range(const toml::table& range, RandomNumber& number, const std::string& file) {
  if (!range.contains("min") || !range.contains("max") || range.size() != 2) {
    fail(number, file, "a table", "{ min = NUMBER, max = NUMBER } or { one_of = [NUMBERS] }");
  }
  number.min = finite_number(*range.get("min"), number, file);
  number.max = finite_number(*range.get("max"), number, file);
  if (!(number.min <= number.max)) {
    fail(number, file, fmt::format("min = {} above max = {}", number.min, number.max), "the two exchanged");
  }
}

void read_list(const toml::table& list, RandomNumber& number, const std::string& file) {
  const toml::array* values = list.get("one_of")->as_array();
  if (values == nullptr || values->empty() || list.size() != 1) {
    fail(number, file, "a table", "{ one_of = [NUMBERS] }, at least one of them");
  }
  number.one_of.reserve(values->size());
  for (const toml::node& value : *values) number.one_of.push_back(finite_number(value, number, file));
}

RandomNumber read_random_number(const std::string& path, const toml::node& node, const std::string& text,
                                const std::string& file) {
  const toml::source_region& source = node.source();
  RandomNumber number{.path = path,
                      .line = source.begin.line,
                      .begin = offset_of(text, source.begin),
                      .end = offset_of(text, source.end),
                      .integer = is_whole(path),
                      .one_of = {}};
  const toml::table& table = *node.as_table();
  if (table.contains("one_of")) {
    read_list(table, number, file);
  } else {
    read_range(table, number, file);
  }
  return number;
}

std::string number_text(const RandomNumber& place, double number) {
  return place.integer ? fmt::format("{}", static_cast<std::int64_t>(number)) : real_text(number);
}

std::string text_of(const toml::node& node);

std::string text_of_array(const toml::array& array) {
  std::vector<std::string> elements;
  elements.reserve(array.size());
  for (const toml::node& element : array) elements.push_back(text_of(element));
  return fmt::format("[{}]", fmt::join(elements, ", "));
}

// Of a number, an array or a number to be drawn.
std::string text_of(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* real = node.as_floating_point()) return real_text(real->get());
  if (const toml::array* array = node.as_array()) return text_of_array(*array);
  const toml::table& table = *node.as_table();
  if (const toml::node* values = table.get("one_of"))
    return fmt::format("{{ one_of = {} }}", text_of(*values));
  return fmt::format("{{ min = {}, max = {} }}", text_of(*table.get("min")), text_of(*table.get("max")));
}

void add_settings(const toml::table& table, const std::string& path, std::vector<RandomSetting>& settings) {
  const auto any_random_of = [&](const auto& keys) {
    return std::ranges::any_of(keys, [&](std::string_view key) {
      const toml::node* node = table.get(key);
      return node != nullptr && holds_random(*node);
    });
  };
  const bool lens = any_random_of(leading_lens_keys);
  const bool pose = any_random_of(pose_keys);
  for (const auto& [key, node] : table) {
    const bool goes_with = (lens && holds(lens_keys, key.str())) || (pose && holds(pose_keys, key.str()));
    if (goes_with || holds_random(node)) settings.push_back({path, std::string(key.str()), text_of(node)});
  }
}

/// Says which table of a resolved recipe comes after which.
class TableOfHeader {
public:
  /// Goes on to the table of this header.
  void enter(const std::string& line) {
    const bool is_array = line.starts_with("[[");
    const std::size_t first = is_array ? 2 : 1;
    const std::string name = line.substr(first, line.find(']') - first);
    if (is_array) {
      ++counts_[name];
      std::erase_if(counts_, [&](const auto& entry) { return entry.first.starts_with(name + '.'); });
    }
    path_ = indexed(name);
  }

  const std::string& path() const { return path_; }

private:
  std::string indexed(const std::string& name) const {
    std::string path;
    std::string prefix;
    std::istringstream parts(name);
    for (std::string part; std::getline(parts, part, '.');) {
      prefix = path_of(prefix, part);
      path = path_of(path, part);
      if (const auto count = counts_.find(prefix); count != counts_.end()) {
        path += fmt::format("[{}]", count->second - 1);
      }
    }
    return path;
  }

  std::map<std::string, std::size_t> counts_;  ///< of the tables of each array so far
  std::string path_;
};

/// Does a resolved recipe's `key` say what one of the settings, under another key, says otherwise?
bool is_replaced(std::string_view key, const std::vector<RandomSetting>& settings) {
  const auto any_of = [&](std::initializer_list<std::string_view> keys) {
    return std::ranges::any_of(settings,
                               [&](const RandomSetting& setting) { return holds(keys, setting.key); });
  };
  if (key == "fx" || key == "fy" || key == "cx" || key == "cy") {
    return any_of({"hfov_deg", "focal_length_px", "width", "height"});
  }
  return key == "rotation_matrix" && any_of({"rotation_wxyz", "look_at"});
}

/// A table of a resolved recipe with settings in place of its own; those that it has not come first.
std::string section_with(const std::vector<std::string>& lines, const std::vector<RandomSetting>& settings) {
  const auto key_of = [](const std::string& line) { return line.substr(0, line.find(' ')); };
  const auto text_of_setting = [](const RandomSetting& setting) {
    return fmt::format("{} = {}\n", setting.key, setting.value);
  };
  std::string first;
  for (const RandomSetting& setting : settings) {
    if (std::ranges::find(lines, setting.key, key_of) == lines.end()) first += text_of_setting(setting);
  }
  std::string text;
  for (const std::string& line : lines) {
    const auto setting = std::ranges::find(settings, key_of(line), &RandomSetting::key);
    if (setting != settings.end()) {
      text += text_of_setting(*setting);
    } else if (!is_replaced(key_of(line), settings)) {
      text += line + '\n';
    }
    if (line.starts_with('[')) text += first;
  }
  return text;
}

}  // namespace

std::vector<RandomNumber> find_random_numbers(const toml::table& root, const std::string& text,
                                              const std::string& file) {
  std::vector<RandomNumber> numbers;
  for_each_node(root, "", [&](const std::string& path, const toml::node& node) {
    if (is_random(node)) numbers.push_back(read_random_number(path, node, text, file));
  });
  std::ranges::sort(numbers, {}, &RandomNumber::begin);
  return numbers;
}

std::string with_numbers(const std::string& text, const std::vector<RandomNumber>& places,
                         const std::vector<double>& numbers) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const RandomNumber& place = places[i];
    const auto replaced = std::string_view(text).substr(place.begin, place.end - place.begin);
    result += text.substr(done, place.begin - done) + number_text(place, numbers[i]);
    result.append(static_cast<std::size_t>(std::ranges::count(replaced, '\n')), '\n');
    done = place.end;
  }
  return result + text.substr(done);
}

double draw_number(const RandomNumber& number, const std::string& name, std::uint64_t recipe_seed,
                   const CaseId& id) {
  constexpr int no_attempt = 0;  // of a scene's: these count from 1
  const std::uint64_t seed = attempt_seed(recipe_seed, id.set, id.tubes, id.number, no_attempt);
  const CounterRandom random(attempt_seed(seed, name, 0, 0, 0), 0);
  const double uniform = random.uniform(0);
  if (!number.one_of.empty()) {
    return number.one_of[static_cast<std::size_t>(uniform * static_cast<double>(number.one_of.size()))];
  }
  if (number.integer)
    return std::min(number.max, std::floor(number.min + uniform * (number.max - number.min + 1)));
  return number.min + uniform * (number.max - number.min);
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

std::vector<RandomSetting> random_settings(const toml::table& root) {
  std::vector<RandomSetting> settings;
  for_each_node(root, "", [&](const std::string& path, const toml::node& node) {
    if (node.is_table() && !is_random(node)) add_settings(*node.as_table(), path, settings);
  });
  return settings;
}

std::string with_settings(const std::string& resolved, const std::vector<RandomSetting>& settings) {
  std::string text;
  TableOfHeader table;
  std::vector<std::string> section;  // the lines of a table, its header first
  const auto finish_section = [&] {
    std::vector<RandomSetting> here;
    std::ranges::copy_if(settings, std::back_inserter(here),
                         [&](const RandomSetting& setting) { return setting.table == table.path(); });
    text += section_with(section, here);
    section.clear();
  };
  std::istringstream lines(resolved);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) {
      finish_section();
      table.enter(line);
    }
    section.push_back(line);
  }
  finish_section();
  return text;
}

}  // namespace tanglebin
