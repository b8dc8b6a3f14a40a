#include "tanglebin/base/counter_random.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

constexpr std::uint64_t draws = 100'000;

template <typename Draw>
std::vector<double> sample(const Draw& draw) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < draws; ++i) values.push_back(draw(i));
  return values;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return 12 * sum / static_cast<double>(a.size());
}

TEST(CounterRandom, ANumberDependsOnItsSeedTermAndCounterAlone) {
  const CounterRandom random(7, 3);
  const double fifth = random.uniform(5);
  for (std::uint64_t i = 100; i > 0; --i) random.uniform(i);
  EXPECT_EQ(CounterRandom(7, 3).uniform(5), fifth);
  EXPECT_NE(CounterRandom(8, 3).uniform(5), fifth);
  EXPECT_NE(CounterRandom(7, 4).uniform(5), fifth);
  EXPECT_NE(CounterRandom(7, 3).uniform(6), fifth);
}

TEST(CounterRandom, GivesTheSameNumbersOnEveryMachine) {
  EXPECT_EQ(CounterRandom(0, 0).bits(0), 0xa706dd2f4d197e6fU);
  EXPECT_EQ(CounterRandom(2022, 5).bits(123456789), 0x3cbaa593db2bff01U);
}

TEST(CounterRandom, IsUniformBetweenZeroAndOne) {
  for (const std::uint64_t seed : {0U, 1U, 2022U}) {
    EXPECT_GT(test::uniform_p(sample([r = CounterRandom(seed, 0)](auto i) { return r.uniform(i); }), 0, 1),
              test::significance);
  }
}

TEST(CounterRandom, NeighbouringSeedsTermsAndCountersAreUnrelated) {
  const auto numbers = [](std::uint64_t seed, std::uint64_t term, std::uint64_t shift) {
    return sample([=](std::uint64_t i) { return CounterRandom(seed, term).uniform(i + shift); });
  };
  const std::vector<double> first = numbers(1, 1, 0);
  const double limit = 4 / std::sqrt(static_cast<double>(draws));
  EXPECT_LT(std::abs(correlation(first, numbers(2, 1, 0))), limit);
  EXPECT_LT(std::abs(correlation(first, numbers(1, 2, 0))), limit);
  EXPECT_LT(std::abs(correlation(first, numbers(1, 1, 1))), limit);
  std::set<double> all(first.begin(), first.end());
  for (const auto& others : {numbers(2, 1, 0), numbers(1, 2, 0)}) all.insert(others.begin(), others.end());
  EXPECT_EQ(all.size(), 3 * draws) << "a number came twice";
}

TEST(CounterRandom, NormalNumbersAreNormal) {
  const boost::math::normal normal;
  const CounterRandom random(2022, 1);
  const auto probabilities =
      sample([&](std::uint64_t i) { return boost::math::cdf(normal, random.normal(i)); });
  EXPECT_GT(test::uniform_p(probabilities, 0, 1), test::significance);
}

TEST(NormalQuantile, IsTheInverseOfTheNormalDistribution) {
  const boost::math::normal normal;
  for (int i = 1; i < 2000; ++i) {
    const double p = i / 2000.0;
    const double expected = boost::math::quantile(normal, p);
    EXPECT_NEAR(normal_quantile(p), expected, 1e-14 * (1 + std::abs(expected))) << p;
  }
  for (double p = 1e-3; p > 1e-300; p /= 7) {
    const double expected = boost::math::quantile(normal, p);
    EXPECT_NEAR(normal_quantile(p) / expected, 1, 1e-14) << p;
  }
}

TEST(CounterRandom, AUniformNumberIsNeverZeroOrOne) {
  constexpr std::uint64_t largest = ~std::uint64_t{0};
  EXPECT_GT(between_0_and_1(0), 0);
  EXPECT_LT(between_0_and_1(largest), 1);
}

}  // namespace
}  // namespace tanglebin
