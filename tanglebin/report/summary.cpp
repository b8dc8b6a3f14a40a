#include "tanglebin/report/summary.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace tanglebin {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

std::optional<double> standard_deviation(const std::vector<double>& sample, double mean) {
  if (sample.size() < 2) return std::nullopt;
  double squares = 0;
  for (const double value : sample) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(sample.size() - 1));
}

std::optional<double> interval(std::size_t count, const std::optional<double>& deviation) {
  if (!deviation) return std::nullopt;
  constexpr double upper = 0.975;
  const boost::math::students_t distribution(static_cast<double>(count - 1));
  return boost::math::quantile(distribution, upper) * *deviation / std::sqrt(static_cast<double>(count));
}

}  // namespace

Summary summarize(std::vector<double> sample) {
  if (sample.empty()) throw std::invalid_argument("a summary of no numbers");
  std::ranges::sort(sample);
  const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
  const std::optional<double> deviation = standard_deviation(sample, mean);
  return {.count = sample.size(),
          .mean = mean,
          .standard_deviation = deviation,
          .interval = interval(sample.size(), deviation),
          .least = sample.front(),
          .first_quartile = quantile(sample, 0.25),
          .median = quantile(sample, 0.5),
          .third_quartile = quantile(sample, 0.75),
          .greatest = sample.back()};
}

}  // namespace tanglebin
