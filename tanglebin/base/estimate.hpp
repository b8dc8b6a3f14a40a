#pragma once

#include <vector>

namespace tanglebin {

/// A mean with its 95 % confidence interval.
struct Estimate {
  double mean = 0;
  double low = 0;
  double high = 0;

  bool operator==(const Estimate&) const = default;
};

/// The mean of at least one value, with the bootstrap's interval: percentiles of the means of 2000 samples
/// drawn with replacement (Efron and Tibshirani 1993, Section 13.3). Always the same for the same values; and
/// samples of equally many values are drawn alike.
Estimate estimate_of_mean(const std::vector<double>& values);

}  // namespace tanglebin
