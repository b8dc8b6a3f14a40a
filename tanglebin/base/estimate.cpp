#include "tanglebin/base/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double resampled_mean(const std::vector<double>& values, Rng& rng) {
  const int last = static_cast<int>(values.size()) - 1;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[static_cast<std::size_t>(uniform_integer(rng, 0, last))];
  return sum / static_cast<double>(values.size());
}

// The value below which this share of the sorted ones lies.
double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

}  // namespace

Estimate estimate_of_mean(const std::vector<double>& values) {
  constexpr std::size_t samples = 2000;
  constexpr std::uint64_t seed = 1;
  constexpr double tail = 0.025;
  Rng rng(seed);
  std::vector<double> means(samples);
  for (double& sample : means) sample = resampled_mean(values, rng);
  std::ranges::sort(means);
  return {mean(values), percentile(means, tail), percentile(means, 1 - tail)};
}

}  // namespace tanglebin
