#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

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
