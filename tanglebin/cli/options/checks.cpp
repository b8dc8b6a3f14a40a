#include "tanglebin/cli/options/checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tanglebin/base/text.hpp"

namespace tanglebin::cli {

CLI::Validator whole_number(int least, int most) {
  const auto complaint = [=](const std::string& text) -> std::string {
    const auto number = to_number<int>(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("found {}, expected a whole number from {} to {}", excerpt(text), least, most);
  };
  return {complaint, fmt::format("{}-{}", least, most)};
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
  const auto complaint = [=](const std::string& text) -> std::string {
    const auto number = to_number<double>(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("found {}, expected a number from {} to {}", excerpt(text), least, most);
  };
  return {complaint, fmt::format("{}-{}", least, most)};
}

}  // namespace tanglebin::cli
