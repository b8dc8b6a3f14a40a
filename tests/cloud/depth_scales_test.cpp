#include "tanglebin/cloud/depth_scales.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tanglebin {
namespace {

using testing::DoubleEq;
using testing::UnorderedElementsAre;

TEST(DepthScales, AreTheToldOneTimesOneTwoOrFiveAndAPowerOfTen) {
  const std::vector<double> scales = other_depth_scales(1000);
  EXPECT_THAT(scales,
              UnorderedElementsAre(DoubleEq(1), DoubleEq(2), DoubleEq(5), DoubleEq(10), DoubleEq(20),
                                   DoubleEq(50), DoubleEq(100), DoubleEq(200), DoubleEq(500), DoubleEq(2000),
                                   DoubleEq(5000), DoubleEq(1e4), DoubleEq(2e4), DoubleEq(5e4), DoubleEq(1e5),
                                   DoubleEq(2e5), DoubleEq(5e5), DoubleEq(1e6)));
  EXPECT_EQ(scales.front(), 1e4);
}

}  // namespace
}  // namespace tanglebin
