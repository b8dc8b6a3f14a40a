#pragma once

#include <initializer_list>
#include <numbers>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tanglebin/files/toml_table.hpp"

// Internal to the library: the keys of a TOML table and the members of a struct that they set.
namespace tanglebin {

template <typename Struct, typename Value>
struct Field {
  const char* key;
  Value Struct::*member;
};
template <typename Struct, typename Value>
Field(const char*, Value Struct::*) -> Field<Struct, Value>;

/// Degrees in the file, radians in the struct.
template <typename Struct>
struct AngleField {
  const char* key;
  double Struct::*member;
};
template <typename Struct>
AngleField(const char*, double Struct::*) -> AngleField<Struct>;

inline double radians_from_degrees(double degrees) {
  constexpr double radians_per_degree = std::numbers::pi / 180;
  return degrees * radians_per_degree;
}

using Keys = std::vector<std::string_view>;

template <typename... Fields>
Keys keys(const std::tuple<Fields...>& fields) {
  return std::apply([](const auto&... field) { return Keys{field.key...}; }, fields);
}

inline Keys all(std::initializer_list<Keys> lists) {
  Keys result;
  for (const Keys& list : lists) result.insert(result.end(), list.begin(), list.end());
  return result;
}

template <typename Struct, typename Value>
void read_field(const TomlTable& table, const Field<Struct, Value>& field,
                std::type_identity_t<Struct>& values) {
  table.get(field.key, values.*field.member);
}

template <typename Struct>
void read_field(const TomlTable& table, const AngleField<Struct>& field,
                std::type_identity_t<Struct>& values) {
  if (!table.has(field.key)) return;
  double degrees = 0;
  table.get(field.key, degrees);
  values.*field.member = radians_from_degrees(degrees);
}

/// Sets the members whose keys the table has.
template <typename Struct, typename... Fields>
void read_fields(const TomlTable& table, const std::tuple<Fields...>& fields, Struct& values) {
  std::apply([&](const auto&... field) { (read_field(table, field, values), ...); }, fields);
}

}  // namespace tanglebin
