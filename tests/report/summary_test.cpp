#include "tanglebin/report/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace tanglebin {
namespace {

// By hand: mean 4, squares of the differences 9 + 4 + 0 + 1 + 16 = 30, of which 30 / 4 = 7.5; the quartiles
// of five numbers are the second and the fourth.
TEST(Summary, OfFiveNumbersIsAsByHand) {
  const Summary summary = summarize({8, 1, 4, 2, 5});
  EXPECT_EQ(summary.count, 5U);
  EXPECT_DOUBLE_EQ(summary.mean, 4);
  EXPECT_DOUBLE_EQ(summary.standard_deviation.value(), std::sqrt(7.5));
  // The quantile 0.975 of Student's t with 4 degrees of freedom is 2.776445 in any table.
  EXPECT_NEAR(summary.interval.value(), 2.776445 * std::sqrt(7.5 / 5), 1e-5);
  EXPECT_EQ(summary.least, 1);
  EXPECT_EQ(summary.first_quartile, 2);
  EXPECT_EQ(summary.median, 4);
  EXPECT_EQ(summary.third_quartile, 5);
  EXPECT_EQ(summary.greatest, 8);
}

TEST(Summary, QuartilesLieBetweenNeighboursWhereNoneIsInTheMiddle) {
  const Summary summary = summarize({4, 3, 2, 1});
  EXPECT_DOUBLE_EQ(summary.first_quartile, 1.75);
  EXPECT_DOUBLE_EQ(summary.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.third_quartile, 3.25);
}

TEST(Summary, OneNumberHasNoStandardDeviation) {
  const Summary summary = summarize({0.5});
  EXPECT_FALSE(summary.standard_deviation.has_value());
  EXPECT_FALSE(summary.interval.has_value());
  EXPECT_EQ(summary.first_quartile, 0.5);
  EXPECT_EQ(summary.third_quartile, 0.5);
}

TEST(Summary, OfNothingIsAMistake) {
  EXPECT_THROW(summarize({}), std::invalid_argument);
}

}  // namespace
}  // namespace tanglebin
