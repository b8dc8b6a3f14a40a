#include "tanglebin/base/median.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace tanglebin {
namespace {

using Weighted = std::vector<std::pair<std::string, std::size_t>>;

TEST(WeightedMedian, IsTheValueOfTheItemInTheMiddle) {
  EXPECT_EQ(weighted_median(Weighted{{"c", 1}, {"a", 2}, {"b", 2}}), "b");
  EXPECT_EQ(weighted_median(Weighted{{"c", 1}, {"a", 9}, {"b", 2}}), "a");
  EXPECT_EQ(weighted_median(Weighted{{"c", 9}, {"a", 0}, {"b", 2}}), "c");
}

TEST(WeightedMedian, OfAnEvenNumberIsTheLowerOfTheTwoInTheMiddle) {
  EXPECT_EQ(weighted_median(Weighted{{"a", 1}, {"b", 1}}), "a");
}

TEST(WeightedMedian, OfNothingIsNothing) {
  EXPECT_EQ(weighted_median(Weighted{}), "");
}

TEST(DeviationAbout, IsTheStandardDeviationOfNormalValuesWhateverAFewOthersAre) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(5, 0.2);
  std::vector<double> values(20'000);
  for (double& value : values) value = normal(random);
  EXPECT_NEAR(deviation_about(5, values), 0.2, 0.005);
  for (std::size_t i = 0; i < 200; ++i) values[i] = 1e9;
  EXPECT_NEAR(deviation_about(5, values), 0.2, 0.01);
}

}  // namespace
}  // namespace tanglebin
