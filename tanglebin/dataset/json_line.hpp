#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_id.hpp"

// Internal to the library: lines of JSON about cases.
namespace tanglebin {

using Json = nlohmann::ordered_json;

/// The members by which every line says which case it is about, and the inverse.
Json id_json(const CaseId& id);
CaseId id_from(const Json& json);

/// Seeds are hexadecimal text, since many readers of JSON take a number for a double, which cannot hold all
/// of a seed.
std::string seed_text(std::uint64_t seed);
std::uint64_t seed_from(const Json& json);

/// A whole number. The library's own conversion takes any number, and one that is out of range is undefined.
template <typename Integer>
Integer integer_from(const Json& json) {
  const bool is_unsigned = json.is_number_unsigned();
  if (is_unsigned && std::in_range<Integer>(json.get<std::uint64_t>())) return json.get<Integer>();
  if (!is_unsigned && json.is_number_integer() && std::in_range<Integer>(json.get<std::int64_t>()))
    return json.get<Integer>();
  throw Json::other_error::create(501, "found " + json.dump() + ", expected a whole number in range",
                                  nullptr);
}

/// Reads one line; whatever is wrong with it becomes an InputError that says where.
template <typename Read>
auto read_json_line(const std::string& line, const std::string& file, std::size_t number, const Read& read) {
  try {
    return read(Json::parse(line));
  } catch (const Json::exception& error) {
    throw InputError({file, number, ""}, error.what());
  }
}

}  // namespace tanglebin
