#include "tanglebin/cli/options/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "tanglebin/base/text.hpp"

namespace tanglebin::cli {

namespace {

template <typename Number>
CLI::Validator within(Number least, Number most, std::string_view a_number) {
  const auto complaint = [=](const std::string& text) -> std::string {
    const auto number = to_number<Number>(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("found {}, expected {} from {} to {}", excerpt(text), a_number, least, most);
  };
  return {complaint, fmt::format("{}-{}", least, most)};
}

}  // namespace

CLI::Validator whole_number(int least, int most) {
  return within(least, most, "a whole number");
}

CLI::Validator finite_number() {
  const auto complaint = [](const std::string& text) -> std::string {
    const auto number = to_number<double>(text);
    if (number && std::isfinite(*number)) return {};
    return fmt::format("found {}, expected a number", excerpt(text));
  };
  return {complaint, ""};
}

CLI::Validator number_within(double least, double most) {
  return within(least, most, "a number");
}

}  // namespace tanglebin::cli
