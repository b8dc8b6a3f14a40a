#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace tanglebin {

/// Statistics of a sample.
struct Summary {
  std::size_t count = 0;
  double mean = 0;
  std::optional<double> standard_deviation;  ///< estimated with n − 1; none for a single number
  std::optional<double> interval;  ///< half the 95 % confidence interval of the mean (Student's t); the same
  double least = 0;
  double first_quartile = 0;  ///< quartiles interpolate between neighbours (Hyndman and Fan 1996, type 7)
  double median = 0;
  double third_quartile = 0;
  double greatest = 0;
};

/// Throws std::invalid_argument for an empty sample.
Summary summarize(std::vector<double> sample);

}  // namespace tanglebin
