#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tanglebin {

/// The median of at least one value; of an even number, the greater of the two in the middle.
template <typename Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The standard deviation of normal errors is so many times the median of their absolute values.
inline constexpr double deviation_of_median = 1.4826;

/// The standard deviation about a middle of the normal distribution whose median distance from it is that of
/// the values, of which there is at least one.
inline double deviation_about(double middle, std::vector<double> values) {
  for (double& value : values) value = std::abs(value - middle);
  return deviation_of_median * median(std::move(values));
}

/// The value of the item in the middle, of values with the numbers of items that have them; of an even number
/// of items, the lesser of the two in the middle; Value{} of none.
template <typename Value>
Value weighted_median(std::vector<std::pair<Value, std::size_t>> values) {
  std::ranges::sort(values);
  std::size_t items = 0;
  for (const auto& [value, count] : values) items += count;
  std::size_t below = 0;
  for (const auto& [value, count] : values) {
    below += count;
    if (2 * below >= items) return value;
  }
  return Value{};
}

}  // namespace tanglebin
