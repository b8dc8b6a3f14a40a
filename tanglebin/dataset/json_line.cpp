#include "tanglebin/dataset/json_line.hpp"

#include <fmt/core.h>

#include <charconv>

namespace tanglebin {

Json id_json(const CaseId& id) {
  return {{"set", id.set}, {"tubes", id.tubes}, {"case", id.number}};
}

CaseId id_from(const Json& json) {
  return {json.at("set").get<std::string>(), integer_from<int>(json.at("tubes")),
          integer_from<int>(json.at("case"))};
}

std::string seed_text(std::uint64_t seed) {
  return fmt::format("{:016x}", seed);
}

std::uint64_t seed_from(const Json& json) {
  const auto text = json.get<std::string>();
  std::uint64_t seed = 0;
  constexpr int hexadecimal = 16;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed, hexadecimal);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw Json::other_error::create(501, "seed is not a hexadecimal number", nullptr);
  }
  return seed;
}

}  // namespace tanglebin
