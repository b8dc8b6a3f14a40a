#include "tanglebin/recipe/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr std::int64_t int_min = std::numeric_limits<int>::min();
constexpr std::int64_t int_max = std::numeric_limits<int>::max();

// Levenshtein's distance: how many characters to insert, remove or replace.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// Which of `known` was meant by `key`: one that differs in few characters, or one that it is the beginning
// of.
std::string hint(std::string_view key, const std::vector<std::string_view>& known) {
  const auto distance = [key](std::string_view other) { return edit_distance(key, other); };
  const auto begins_with_key = [key](std::string_view other) {
    return !key.empty() && other.starts_with(key);
  };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (distance(*nearest) <= std::max<std::size_t>(1, key.size() / 3))
    return fmt::format("did you mean {}?", excerpt(*nearest));
  const auto longer = std::ranges::find_if(known, begins_with_key);
  if (longer != known.end()) return fmt::format("did you mean {}?", excerpt(*longer));
  return fmt::format("expected one of {}", fmt::join(known, ", "));
}

std::string description(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return excerpt(node.as_string()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    case toml::node_type::integer:
      return fmt::format("{}", node.as_integer()->get());
    case toml::node_type::floating_point:
      return real_text(node.as_floating_point()->get());
    default:
      return "a date or time";
  }
}

}  // namespace

std::string real_text(double value) {
  const std::string text = fmt::format("{}", value);
  const bool is_float = text.find_first_of(".ein") != std::string::npos;  // also "inf" and "nan"
  return is_float ? text : text + ".0";
}

TomlTable::TomlTable(const std::string& file, const toml::table& table, std::string path)
    : file_(file), table_(table), path_(std::move(path)) {}

void TomlTable::allow(const std::vector<std::string_view>& known) const {
  for (const auto& [key, node] : table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    throw InputError({file_, key.source().begin.line, path_},
                     fmt::format("unknown key {}, {}", excerpt(key.str()), hint(key.str(), known)));
  }
}

void TomlTable::require(std::initializer_list<std::string_view> keys) const {
  for (const std::string_view key : keys)
    if (!has(key)) throw InputError({file_, line(key), path_of(key)}, "is missing");
}

void TomlTable::allow_one_of(std::initializer_list<std::string_view> keys) const {
  std::string_view first;
  for (const std::string_view key : keys) {
    if (!has(key)) continue;
    if (!first.empty())
      throw InputError({file_, line(key), path_of(key)}, fmt::format("cannot stand beside {}", first));
    first = key;
  }
}

void TomlTable::get(std::string_view key, double& value) const {
  if (const toml::node* node = find(key)) value = real({*node, key});
}

void TomlTable::get(std::string_view key, int& value) const {
  if (const toml::node* node = find(key)) value = static_cast<int>(integer({*node, key}, int_min, int_max));
}

void TomlTable::get(std::string_view key, std::uint64_t& value) const {
  if (const toml::node* node = find(key))
    value = static_cast<std::uint64_t>(integer({*node, key}, 0, std::numeric_limits<std::int64_t>::max()));
}

void TomlTable::get(std::string_view key, bool& value) const {
  if (const toml::node* node = find(key)) value = as<bool>({*node, key}, "true or false");
}

void TomlTable::get(std::string_view key, std::string& value) const {
  if (const toml::node* node = find(key)) value = as<std::string>({*node, key}, "a string");
}

void TomlTable::get(std::string_view key, std::vector<int>& values) const {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  values.clear();
  for (const toml::node& element : array({*node, key}, "an array of whole numbers"))
    values.push_back(static_cast<int>(integer({element, key}, int_min, int_max)));
}

void TomlTable::get(std::string_view key, Eigen::Vector3d& values) const {
  if (const toml::node* node = find(key)) values = vector<3>({*node, key});
}

void TomlTable::get(std::string_view key, Eigen::Vector4d& values) const {
  if (const toml::node* node = find(key)) values = vector<4>({*node, key});
}

void TomlTable::get(std::string_view key, Eigen::Matrix3d& values) const {
  const toml::node* node = find(key);
  if (node == nullptr) return;
  const std::string expected = "an array of 3 rows";
  const toml::array& rows = array({*node, key}, expected);
  if (rows.size() != 3) fail({*node, key}, fmt::format("an array of {}", rows.size()), expected);
  for (std::size_t i = 0; i < 3; ++i) values.row(static_cast<Eigen::Index>(i)) = vector<3>({rows[i], key});
}

TomlTable TomlTable::table(std::string_view key) const {
  static const toml::table none;
  const toml::node* node = find(key);
  if (node == nullptr) return {file_, none, path_of(key)};
  if (!node->is_table()) fail(key, description(*node), fmt::format("a table [{}]", key));
  return {file_, *node->as_table(), path_of(key)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const std::string expected = fmt::format("an array of tables [[{}]]", key);
  for (const toml::node& element : array({*node, key}, expected)) {
    if (!element.is_table()) fail({element, key}, description(element), expected);
    result.emplace_back(file_, *element.as_table(), fmt::format("{}[{}]", path_of(key), result.size()));
  }
  return result;
}

std::size_t TomlTable::line(std::string_view key) const {
  const toml::node* node = find(key);
  return (node != nullptr ? *node : table_).source().begin.line;
}

void TomlTable::fail(std::string_view key, const std::string& found, const std::string& expected) const {
  throw InputError({file_, line(key), path_of(key)}, found, expected);
}

std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

double TomlTable::real(const Value& value) const {
  const double number = value.node.is_integer() ? static_cast<double>(value.node.as_integer()->get())
                                                : as<double>(value, "a number");
  if (!std::isfinite(number)) fail(value, description(value.node), "a finite number");
  return number;
}

std::int64_t TomlTable::integer(const Value& value, std::int64_t least, std::int64_t most) const {
  const auto number = as<std::int64_t>(value, "a whole number");
  if (number < least || number > most)
    fail(value, description(value.node), fmt::format("a whole number from {} to {}", least, most));
  return number;
}

template <int Size>
Eigen::Matrix<double, Size, 1> TomlTable::vector(const Value& value) const {
  const std::string expected = fmt::format("an array of {} numbers", Size);
  const toml::array& elements = array(value, expected);
  if (elements.size() != Size) fail(value, fmt::format("an array of {}", elements.size()), expected);
  Eigen::Matrix<double, Size, 1> numbers;
  for (std::size_t i = 0; i < Size; ++i)
    numbers[static_cast<Eigen::Index>(i)] = real({elements[i], value.key});
  return numbers;
}

const toml::array& TomlTable::array(const Value& value, const std::string& expected) const {
  if (!value.node.is_array()) fail(value, description(value.node), expected);
  return *value.node.as_array();
}

template <typename Type>
const Type& TomlTable::as(const Value& value, const std::string& expected) const {
  const toml::value<Type>* typed = value.node.as<Type>();
  if (typed == nullptr) fail(value, description(value.node), expected);
  return typed->get();
}

void TomlTable::fail(const Value& value, const std::string& found, const std::string& expected) const {
  throw InputError({file_, value.node.source().begin.line, path_of(value.key)}, found, expected);
}

}  // namespace tanglebin
