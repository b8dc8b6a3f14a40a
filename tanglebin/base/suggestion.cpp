#include "tanglebin/base/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

// How many characters to insert, remove or replace, or neighbours to swap (optimal string alignment).
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before_last;  // how far the first i - 2 characters are from each beginning of `to`
  std::vector<std::size_t> last(to.size() + 1);  // of the first i - 1 characters
  std::vector<std::size_t> current(to.size() + 1);
  std::iota(current.begin(), current.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last = std::exchange(last, current);
    current[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      current[j] = std::min({replaced, last[j] + 1, current[j - 1] + 1});
      const bool are_swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (are_swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
  }
  return current[to.size()];
}

// One that differs in few characters or begins with the name, if there is any.
std::optional<std::string_view> nearest_name(std::string_view name,
                                             const std::vector<std::string_view>& known) {
  constexpr std::size_t longest = 64;  // what is longer is no name that was mistyped
  if (name.size() > longest) return std::nullopt;
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
