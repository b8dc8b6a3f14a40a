#include "tanglebin/base/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

// Levenshtein's distance: how many characters to insert, remove or replace.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggestion(std::string_view name, const std::vector<std::string_view>& known) {
  const auto distance = [name](std::string_view other) { return edit_distance(name, other); };
  const auto begins_with_name = [name](std::string_view other) {
    return !name.empty() && other.starts_with(name);
  };
  const auto nearest = std::ranges::min_element(known, {}, distance);
  if (distance(*nearest) <= std::max<std::size_t>(1, name.size() / 3))
    return fmt::format("did you mean {}?", excerpt(*nearest));
  const auto longer = std::ranges::find_if(known, begins_with_name);
  if (longer != known.end()) return fmt::format("did you mean {}?", excerpt(*longer));
  return fmt::format("expected one of {}", fmt::join(known, ", "));
}

}  // namespace tanglebin
