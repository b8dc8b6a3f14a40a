#include "tanglebin/geometry/axis_parts.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tanglebin {
namespace {

std::vector<AxisPart> parts_of(double length, double length_max) {
  return axis_parts({.a = {1, 2, 3}, .b = {1, 2 + length, 3}, .radius = 0.01}, length_max);
}

TEST(AxisParts, AreEqualAndCoverTheAxis) {
  const std::vector<AxisPart> parts = parts_of(0.25, 0.1);
  ASSERT_EQ(parts.size(), 3U);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_DOUBLE_EQ(parts[i].length, 0.25 / 3);
    EXPECT_NEAR(parts[i].middle.y(), 2 + (static_cast<double>(i) + 0.5) * 0.25 / 3, 1e-12);
    EXPECT_EQ(parts[i].middle.x(), 1);
    EXPECT_EQ(parts[i].middle.z(), 3);
  }
}

TEST(AxisParts, AreNoneOfAnAxisWithoutLength) {
  EXPECT_TRUE(parts_of(0, 0.1).empty());
}

// 0.3 / 0.1 is a little more than 3.
TEST(AxisParts, AreNoMoreForRounding) {
  EXPECT_EQ(parts_of(0.1 + 0.2, 0.1).size(), 3U);
}

TEST(AxisParts, AreAThousandAtMost) {
  EXPECT_EQ(parts_of(500, 0.001).size(), 1000U);
}

}  // namespace
}  // namespace tanglebin
