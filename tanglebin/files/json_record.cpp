#include "tanglebin/files/json_record.hpp"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <utility>

#include "tanglebin/base/text.hpp"

namespace tanglebin {

Json parse_json(const std::string& text, const InputPlace& place) {
  constexpr int deepest = 64;
  constexpr int most_keys = 10000;
  std::array<int, deepest + 2> keys{};  // of the object at each depth
  const auto expect_bounded = [&](int depth, Json::parse_event_t event, const Json&) {
    if (depth > deepest)
      throw InputError(place, "JSON nested too deep", fmt::format("at most {} levels", deepest));
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) keys[level + 1] = 0;
    if (event == Json::parse_event_t::key && ++keys[level] > most_keys)
      throw InputError(place, "a JSON object with too many keys", fmt::format("at most {}", most_keys));
    return true;
  };
  return Json::parse(text, expect_bounded, /* allow_exceptions */ false);
}

std::string json_text(const Json& json) {
  constexpr int in_one_line = -1;
  return json.dump(in_one_line, ' ', /* ensure_ascii */ false, Json::error_handler_t::replace);
}

std::string seed_text(std::uint64_t seed) {
  return fmt::format("{:016x}", seed);
}

JsonRecord::JsonRecord(const std::string& text, std::string file, std::size_t line)
    : file_(std::move(file)), line_(line) {
  json_ = parse_json(text, {file_, line_, ""});
  if (!json_.is_object()) throw InputError({file_, line_, ""}, excerpt(text), "a JSON object");
}

JsonRecord::JsonRecord(Json json, const JsonRecord& parent, const std::string& field)
    : file_(parent.file_),
      line_(parent.line_),
      prefix_(parent.prefix_ + field + "."),
      json_(std::move(json)) {
  if (!json_.is_object()) parent.fail(field, excerpt(json_.dump()), "a JSON object");
}

std::vector<std::string> JsonRecord::fields() const {
  std::vector<std::string> names;
  names.reserve(json_.size());
  for (const auto& [name, value] : json_.items()) names.push_back(name);
  return names;
}

std::string JsonRecord::text(const std::string& field) const {
  return text(field, at(field));
}

std::optional<std::string> JsonRecord::text_if_there(const std::string& field) const {
  const auto found = json_.find(field);
  if (found == json_.end() || found->is_null()) return std::nullopt;
  return text(field, *found);
}

std::vector<std::string> JsonRecord::texts(const std::string& field) const {
  std::vector<std::string> result;
  for (const Json& value : list(field)) result.push_back(text(field, value));
  return result;
}

std::uint64_t JsonRecord::whole_number(const std::string& field) const {
  const Json& value = at(field);
  if (!value.is_number_unsigned()) fail(field, excerpt(value.dump()), "a whole number, 0 or more");
  return value.get<std::uint64_t>();
}

int JsonRecord::positive_int(const std::string& field) const {
  constexpr auto greatest = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  const std::uint64_t value = whole_number(field);
  if (value < 1 || value > greatest) fail(field, std::to_string(value), fmt::format("1 to {}", greatest));
  return static_cast<int>(value);
}

std::uint64_t JsonRecord::seed(const std::string& field) const {
  const std::string digits = text(field);
  std::uint64_t seed = 0;
  constexpr int hexadecimal = 16;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seed, hexadecimal);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    fail(field, excerpt(digits), "a hexadecimal number of 64 bits");
  }
  return seed;
}

double JsonRecord::number(const std::string& field, double least, double greatest) const {
  return number(field, at(field), least, greatest);
}

std::optional<double> JsonRecord::number_or_null(const std::string& field, double least,
                                                 double greatest) const {
  const Json& value = at(field);
  if (value.is_null()) return std::nullopt;
  return number(field, value, least, greatest);
}

std::vector<double> JsonRecord::numbers(const std::string& field, double least, double greatest) const {
  std::vector<double> result;
  for (const Json& value : list(field)) result.push_back(number(field, value, least, greatest));
  return result;
}

JsonRecord JsonRecord::object(const std::string& field) const {
  return {at(field), *this, field};
}

std::vector<JsonRecord> JsonRecord::objects(const std::string& field) const {
  std::vector<JsonRecord> result;
  for (const Json& value : list(field)) {
    result.push_back({value, *this, fmt::format("{}[{}]", field, result.size())});
  }
  return result;
}

void JsonRecord::fail(const std::string& field, const std::string& found, const std::string& expected) const {
  throw InputError({file_, line_, prefix_ + field}, found, expected);
}

const Json& JsonRecord::at(const std::string& field) const {
  const auto found = json_.find(field);
  if (found == json_.end()) throw InputError({file_, line_, prefix_ + field}, "is missing");
  return *found;
}

const Json& JsonRecord::list(const std::string& field) const {
  const Json& value = at(field);
  if (!value.is_array()) fail(field, excerpt(value.dump()), "a list");
  return value;
}

std::string JsonRecord::text(const std::string& field, const Json& value) const {
  if (!value.is_string()) fail(field, excerpt(value.dump()), "text");
  return value.get<std::string>();
}

double JsonRecord::number(const std::string& field, const Json& value, double least, double greatest) const {
  if (!value.is_number()) fail(field, excerpt(value.dump()), "a number");
  const auto number = value.get<double>();
  if (!(number >= least && number <= greatest)) {
    fail(field, excerpt(value.dump()),
         greatest == infinity ? fmt::format("{} or more", least)
                              : fmt::format("a number from {} to {}", least, greatest));
  }
  return number;
}

}  // namespace tanglebin
