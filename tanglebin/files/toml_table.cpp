#include "tanglebin/files/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/suggestion.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/toml_text.hpp"

namespace tanglebin {
namespace {

constexpr std::int64_t int_min = std::numeric_limits<int>::min();
constexpr std::int64_t int_max = std::numeric_limits<int>::max();

}  // namespace

std::string real_text(double value) {
  const std::string text = fmt::format("{}", value);
  const bool is_float = text.find_first_of(".ein") != std::string::npos;  // also "inf" and "nan"
  return is_float ? text : text + ".0";
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

std::string path_of(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

void for_each_node(const toml::node& node, const std::string& path,
                   const std::function<bool(const std::string&, const toml::node&)>& visit) {
  if (!visit(path, node)) return;
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) for_each_node(value, path_of(path, key.str()), visit);
  }
  if (const toml::array* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      for_each_node((*array)[i], fmt::format("{}[{}]", path, i), visit);
    }
  }
}

TomlSource::TomlSource(std::string file, const toml::table& root) : file_(std::move(file)) {
  for_each_node(root, "", [&](const std::string& path, const toml::node& node) {
    lines_.emplace(path, node.source().begin.line);
    return true;
  });
}

std::size_t TomlSource::line(const std::string& path) const {
  const auto found = lines_.find(path);
  return found == lines_.end() ? 0 : found->second;
}

std::size_t TomlSource::line_of_field(std::string field) const {
  while (!field.empty()) {
    for (const char* unit : {"", "_deg"})
      if (const std::size_t found = line(field + unit)) return found;
    const std::size_t last = field.find_last_of(".[");
    field.resize(last == std::string::npos ? 0 : last);
  }
  return 0;
}

void TomlSource::take_lines(const std::string& path, const std::string& original) {
  std::map<std::string, std::size_t> copies;
  for (const auto& [place, line] : lines_)
    if (place.starts_with(original)) copies.emplace(path + place.substr(original.size()), line);
  lines_.merge(copies);
}

toml::table parse_toml(const std::string& text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some editors begin a file with it
  if (text.starts_with(byte_order_mark)) return parse_toml(text.substr(byte_order_mark.size()), name);
  try {
    return toml::parse(checked_toml(text, name), name);
  } catch (const toml::parse_error& error) {
    // The description may quote the end of a line.
    std::string problem(error.description());
    std::ranges::replace_if(
        problem, [](char c) { return c < ' '; }, ' ');
    throw InputError({name, error.source().begin.line, ""}, problem);
  }
}

void validate_at(const TomlSource& source, const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    throw InputError({source.file(), source.line_of_field(error.place().field), ""}, error.what());
  }
}

TomlTable::TomlTable(const TomlSource& source, const toml::table& table, std::string path)
    : source_(source), table_(table), path_(std::move(path)) {}

void TomlTable::allow(const std::vector<std::string_view>& known) const {
  for (const auto& [key, node] : table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    throw InputError({file(), key.source().begin.line, path_},
                     fmt::format("unknown key {}, {}", excerpt(key.str()), suggestion(key.str(), known)));
  }
}

void TomlTable::require(std::initializer_list<std::string_view> keys) const {
  for (const std::string_view key : keys)
    if (!has(key)) throw InputError(place(key), "is missing");
}

void TomlTable::allow_one_of(std::initializer_list<std::string_view> keys) const {
  std::string_view first;
  for (const std::string_view key : keys) {
    if (!has(key)) continue;
    if (!first.empty()) throw InputError(place(key), fmt::format("cannot be combined with {}", first));
    first = key;
  }
}

void TomlTable::get(std::string_view key, double& value) const {
  if (const auto found = value_of(key)) value = real(*found);
}

void TomlTable::get(std::string_view key, int& value) const {
  if (const auto found = value_of(key)) value = static_cast<int>(integer(*found, int_min, int_max));
}

void TomlTable::get(std::string_view key, std::uint64_t& value) const {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  if (const auto found = value_of(key)) value = static_cast<std::uint64_t>(integer(*found, 0, most));
}

void TomlTable::get(std::string_view key, bool& value) const {
  if (const auto found = value_of(key)) value = as<bool>(*found, "true or false");
}

void TomlTable::get(std::string_view key, std::string& value) const {
  if (const auto found = value_of(key)) value = as<std::string>(*found, "a string");
}

void TomlTable::get(std::string_view key, std::vector<int>& values) const {
  const auto found = value_of(key);
  if (!found) return;
  values.clear();
  for (const Value& element : elements(*found, "an array of whole numbers"))
    values.push_back(static_cast<int>(integer(element, int_min, int_max)));
}

void TomlTable::get(std::string_view key, Eigen::Vector3d& values) const {
  if (const auto found = value_of(key)) values = vector<3>(*found);
}

void TomlTable::get(std::string_view key, Eigen::Vector4d& values) const {
  if (const auto found = value_of(key)) values = vector<4>(*found);
}

void TomlTable::get(std::string_view key, Eigen::Matrix3d& values) const {
  get_rows(key, values);
}

void TomlTable::get(std::string_view key, Eigen::Matrix4d& values) const {
  get_rows(key, values);
}

template <int Size>
void TomlTable::get_rows(std::string_view key, Eigen::Matrix<double, Size, Size>& values) const {
  const auto found = value_of(key);
  if (!found) return;
  const std::string expected = fmt::format("an array of {} rows", Size);
  const std::vector<Value> rows = elements(*found, expected);
  if (rows.size() != Size) fail(*found, fmt::format("an array of {}", rows.size()), expected);
  for (std::size_t i = 0; i < Size; ++i) values.row(static_cast<Eigen::Index>(i)) = vector<Size>(rows[i]);
}

TomlTable TomlTable::table(std::string_view key) const {
  static const toml::table none;
  const toml::node* node = find(key);
  if (node == nullptr) return {source_, none, path_of(key)};
  if (!node->is_table()) fail(key, description(*node), fmt::format("a table [{}]", key));
  return {source_, *node->as_table(), path_of(key)};
}

const toml::table* TomlTable::raw_table(std::string_view key) const {
  const toml::node* node = find(key);
  return node == nullptr ? nullptr : node->as_table();
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> result;
  const auto found = value_of(key);
  if (!found) return result;
  const std::string expected = fmt::format("an array of tables [[{}]]", key);
  for (const Value& element : elements(*found, expected)) {
    if (!element.node.is_table()) fail(element, description(element.node), expected);
    result.emplace_back(source_, *element.node.as_table(), element.path);
  }
  return result;
}

std::size_t TomlTable::line(std::string_view key) const {
  return source_.line(has(key) ? path_of(key) : path_);
}

void TomlTable::fail(std::string_view key, const std::string& found, const std::string& expected) const {
  throw InputError(place(key), found, expected);
}

std::optional<TomlTable::Value> TomlTable::value_of(std::string_view key) const {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return Value{*node, key, path_of(key)};
}

std::vector<TomlTable::Value> TomlTable::elements(const Value& value, const std::string& expected) const {
  if (!value.node.is_array()) fail(value, description(value.node), expected);
  std::vector<Value> result;
  for (const toml::node& element : *value.node.as_array())
    result.push_back({element, value.key, fmt::format("{}[{}]", value.path, result.size())});
  return result;
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
  const std::vector<Value> numbers = elements(value, expected);
  if (numbers.size() != Size) fail(value, fmt::format("an array of {}", numbers.size()), expected);
  Eigen::Matrix<double, Size, 1> result;
  for (std::size_t i = 0; i < Size; ++i) result[static_cast<Eigen::Index>(i)] = real(numbers[i]);
  return result;
}

template <typename Type>
const Type& TomlTable::as(const Value& value, const std::string& expected) const {
  const toml::value<Type>* typed = value.node.as<Type>();
  if (typed == nullptr) fail(value, description(value.node), expected);
  return typed->get();
}

void TomlTable::fail(const Value& value, const std::string& found, const std::string& expected) const {
  throw InputError({file(), source_.line(value.path), path_of(value.key)}, found, expected);
}

}  // namespace tanglebin
