#pragma once

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tanglebin::test {

/// Statistical tests below this probability fail. Seeds are fixed, so that they fail always or never.
constexpr double significance = 1e-4;

/// Probability that Kolmogorov's distribution exceeds the distance d of n samples (Stephens 1970).
inline double kolmogorov_p(double d, double n) {
  const double lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * d;
  if (lambda < 0.2) return 1;  // 1 to all digits, and the series below converges slowly
  double p = 0;
  double sign = 2;
  for (int k = 1; k <= 100; ++k, sign = -sign) p += sign * std::exp(-2.0 * k * k * lambda * lambda);
  return std::clamp(p, 0.0, 1.0);
}

/// Kolmogorov-Smirnov: the probability of a sample no more uniform on [low, high] than this one.
inline double uniform_p(std::vector<double> sample, double low, double high) {
  std::ranges::sort(sample);
  const double n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double expected = (sample[i] - low) / (high - low);
    distance = std::max(
        {distance, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
  }
  return kolmogorov_p(distance, n);
}

/// Kolmogorov-Smirnov: the probability that two samples of one distribution differ at least this much.
inline double same_distribution_p(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  const auto share_up_to = [](const std::vector<double>& sorted, double x) {
    return static_cast<double>(std::ranges::upper_bound(sorted, x) - sorted.begin()) /
           static_cast<double>(sorted.size());
  };
  double distance = 0;
  for (const std::vector<double>* sample : {&a, &b}) {
    for (const double x : *sample)
      distance = std::max(distance, std::abs(share_up_to(a, x) - share_up_to(b, x)));
  }
  const double sizes = static_cast<double>(a.size()) * static_cast<double>(b.size());
  return kolmogorov_p(distance, sizes / static_cast<double>(a.size() + b.size()));
}

/// Chi-square: the probability of counts at least this far from all equal.
inline double equal_counts_p(const std::vector<std::size_t>& counts) {
  const double bins = static_cast<double>(counts.size());
  const double expected = std::accumulate(counts.begin(), counts.end(), 0.0) / bins;
  double statistic = 0;
  for (const std::size_t count : counts) {
    const double difference = static_cast<double>(count) - expected;
    statistic += difference * difference / expected;
  }
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(bins - 1), statistic));
}

}  // namespace tanglebin::test
