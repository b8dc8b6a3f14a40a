#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/base/error.hpp"

// Internal to the library: JSON of datasets and results.
namespace tanglebin {

using Json = nlohmann::ordered_json;

/// Parses text as JSON; a value for which is_discarded() holds if it is none. Throws InputError at `place` if
/// it is nested more than 64 deep, since what reads JSON later may call itself once per level, or if an
/// object has more than 10,000 keys, since Json looks for each of them among all.
Json parse_json(const std::string& text, const InputPlace& place);

/// JSON in one line. Bytes of strings that are not UTF-8, as file names may have, become U+FFFD: JSON cannot
/// hold them.
std::string json_text(const Json& json);

/// Seeds are hexadecimal text. Many JSON readers convert numbers to double, which cannot hold all 64 bits.
std::string seed_text(std::uint64_t seed);

/// A number as JSON; null if there is none.
template <typename Number>
Json number_or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

/// A JSON object from a file, with values read by name. Every function throws InputError with file, line and
/// field if a value is missing or not as expected.
class JsonRecord {
public:
  JsonRecord(const std::string& text, std::string file, std::size_t line);

  bool has(const std::string& field) const { return json_.contains(field); }
  std::vector<std::string> fields() const;
  const Json& json() const { return json_; }

  std::string text(const std::string& field) const;
  std::optional<std::string> text_if_there(const std::string& field) const;  ///< none if missing or null
  std::vector<std::string> texts(const std::string& field) const;
  std::uint64_t whole_number(const std::string& field) const;
  int positive_int(const std::string& field) const;
  std::uint64_t seed(const std::string& field) const;

  double number(const std::string& field, double least = -infinity, double greatest = infinity) const;
  std::optional<double> number_or_null(const std::string& field, double least, double greatest) const;
  std::vector<double> numbers(const std::string& field, double least, double greatest) const;

  JsonRecord object(const std::string& field) const;
  std::vector<JsonRecord> objects(const std::string& field) const;

  /// Throws an InputError about a field.
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const;

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  JsonRecord(Json json, const JsonRecord& parent, const std::string& field);

  const Json& at(const std::string& field) const;
  const Json& list(const std::string& field) const;
  std::string text(const std::string& field, const Json& value) const;
  double number(const std::string& field, const Json& value, double least, double greatest) const;

  std::string file_;
  std::size_t line_;
  std::string prefix_;  ///< of its fields, such as "files[2]."
  Json json_;
};

}  // namespace tanglebin
