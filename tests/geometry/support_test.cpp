#include "tanglebin/geometry/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

bool is_solid(const std::vector<AlignedBox3d>& parts, const Vector3d& place) {
  return std::ranges::any_of(parts, [&](const AlignedBox3d& part) { return part.contains(place); });
}

TEST(Support, IsSurelySolidWhereItIsForAllBinsWithinItsMargin) {
  const Support support{.margin = 0.005};
  const Bin& bin = support.bin;
  const std::vector<AlignedBox3d> parts = surely_solid_parts(support);
  EXPECT_FALSE(is_solid(parts, {0, 0, -0.004}));
  EXPECT_TRUE(is_solid(parts, {0, 0, -0.006}));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(is_solid(parts, {side * (bin.length / 2 + 0.004), 0, 0.1}));
    EXPECT_TRUE(is_solid(parts, {side * (bin.length / 2 + 0.006), 0, 0.1}));
    EXPECT_FALSE(is_solid(parts, {0, side * (bin.width / 2 + 0.004), 0.1}));
    EXPECT_TRUE(is_solid(parts, {0, side * (bin.width / 2 + 0.006), 0.1}));
  }
  EXPECT_TRUE(is_solid(parts, {bin.length / 2 + 0.01, 0, bin.height - 0.006}));
  EXPECT_FALSE(is_solid(parts, {bin.length / 2 + 0.01, 0, bin.height - 0.004}));
}

TEST(Support, WithoutAMarginIsSolidForSureWhereItIsSolid) {
  for (const auto shape : {Support::Shape::bin, Support::Shape::plane, Support::Shape::nothing}) {
    const Support support{.shape = shape};
    const std::vector<AlignedBox3d> sure = surely_solid_parts(support);
    const std::vector<AlignedBox3d> parts = solid_parts(support);
    ASSERT_EQ(sure.size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      EXPECT_EQ(sure[i].min(), parts[i].min());
      EXPECT_EQ(sure[i].max(), parts[i].max());
    }
  }
}

TEST(Support, HoldsOnlyTubesIfItIsABinWhoseShapeIsKnownExactly) {
  EXPECT_TRUE(holds_only_tubes({.shape = Support::Shape::bin}));
  EXPECT_FALSE(holds_only_tubes({.shape = Support::Shape::bin, .margin = 0.001}));
  EXPECT_FALSE(holds_only_tubes({.shape = Support::Shape::plane}));
  EXPECT_FALSE(holds_only_tubes({.shape = Support::Shape::nothing}));
}

TEST(Support, OfAPlaneIsSolidWithoutBordersFromItsMarginOn) {
  const auto parts = surely_solid_parts({.shape = Support::Shape::plane, .margin = 0.003});
  constexpr double far = 1e6;
  EXPECT_TRUE(is_solid(parts, {far, -far, -0.0031}));
  EXPECT_FALSE(is_solid(parts, {far, -far, -0.0029}));
}

}  // namespace
}  // namespace tanglebin
