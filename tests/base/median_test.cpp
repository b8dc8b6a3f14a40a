#include "tanglebin/base/median.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tanglebin
