#include "tanglebin/base/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

// How many characters to insert, remove or replace, or neighbours to swap (optimal string alignment).
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::vector<std::size_t>> distances(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i) distances[i][0] = i;
  for (std::size_t j = 0; j <= to.size(); ++j) distances[0][j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = distances[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      distances[i][j] = std::min({replaced, distances[i - 1][j] + 1, distances[i][j - 1] + 1});
      const bool are_swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (are_swapped) distances[i][j] = std::min(distances[i][j], distances[i - 2][j - 2] + 1);
    }
  }
  return distances[from.size()][to.size()];
}

// One that differs in few characters or begins with the name, if there is any.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known) {
  const auto distance = [name](std::string_view other) { return edit_distance(name, other); };
  const auto begins_with_name = [name](std::string_view other) {
    return !name.empty() && other.starts_with(name);
  };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (distance(*nearest) <= std::max<std::size_t>(1, name.size() / 3)) return *nearest;
  const auto longer = std::ranges::find_if(known, begins_with_name);
  return longer != known.end() ? std::optional(*longer) : std::nullopt;
}

}  // namespace

std::string suggestion(std::string_view name, const std::vector<std::string_view>& known,
                       std::string_view expected) {
  if (const auto nearest = nearest_name(name, known))
    return fmt::format("did you mean {}?", excerpt(*nearest));
  if (!expected.empty()) return fmt::format("expected {}", expected);
  return fmt::format("expected one of {}", fmt::join(known, ", "));
}

void reject_name(std::string_view name, const std::vector<std::string_view>& known,
                 std::string_view expected) {
  throw InputError({}, fmt::format("found {}, {}", excerpt(name), suggestion(name, known, expected)));
}

}  // namespace tanglebin
