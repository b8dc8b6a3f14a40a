#include "tanglebin/base/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

TEST(EstimateOfMean, HasTheIntervalOfTheNormalDistributionForManyValues) {
  Rng rng(3);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(uniform_real(rng, 0, 1));
  const Estimate estimate = estimate_of_mean(values);
  const double half = 1.96 * std::sqrt(1.0 / 12 / 1000);
  EXPECT_NEAR(estimate.mean, 0.5, half);
  EXPECT_NEAR(estimate.low, estimate.mean - half, 0.003);
  EXPECT_NEAR(estimate.high, estimate.mean + half, 0.003);
}

TEST(EstimateOfMean, OfEqualValuesIsCertain) {
  EXPECT_EQ(estimate_of_mean({0.5, 0.5, 0.5}), (Estimate{0.5, 0.5, 0.5}));
}

TEST(EstimateOfMean, IsAlwaysTheSame) {
  EXPECT_EQ(estimate_of_mean({1, 2, 4}), estimate_of_mean({1, 2, 4}));
}

}  // namespace
}  // namespace tanglebin
