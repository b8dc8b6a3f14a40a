#include "tanglebin/model/axis/links/obstacles.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/model/axis/fragments/straight_fragment.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::radius;
using test::straight_fragment;

constexpr std::size_t none = 9;

// Two fragments of a node at each end, 30 cm apart.
const std::vector<Fragment> fragments = {straight_fragment({0, 0, 0}, {0.3, 0, 0}),
                                         straight_fragment({0, 0.1, 0}, {0.3, 0.1, 0})};

TEST(Obstacles, OverlapAnAxisThatIsNearerThanADiameter) {
  const Obstacles obstacles(fragments, radius, {});
  EXPECT_NEAR(obstacles.overlap({0, 0, 0}, none, none), 1, 1e-12);
  EXPECT_NEAR(obstacles.overlap({0, radius, 0}, none, none), 0.5, 1e-12);
  EXPECT_NEAR(obstacles.overlap({0.3, 0, -1.5 * radius}, none, none), 0.25, 1e-12);
  EXPECT_EQ(obstacles.overlap({0, 2 * radius, 0}, none, none), 0);
  EXPECT_EQ(obstacles.overlap({5, 5, 5}, none, none), 0);
}

TEST(Obstacles, AreNotTheTwoFragmentsThatAreAskedFor) {
  const Obstacles obstacles(fragments, radius, {});
  EXPECT_EQ(obstacles.overlap({0, 0, 0}, 0, none), 0);
  EXPECT_EQ(obstacles.overlap({0, 0, 0}, none, 0), 0);
  EXPECT_NEAR(obstacles.overlap({0, 0.1, 0}, 0, none), 1, 1e-12);
}

TEST(Obstacles, OfOtherKindsReachAsFarAsTheTwoTubesTouch) {
  const Obstacles obstacles({}, radius, {{{0, 0, 0}, 3 * radius}});
  EXPECT_NEAR(obstacles.overlap({0, 0, 0}, none, none), 1, 1e-12);
  EXPECT_NEAR(obstacles.overlap({0, 3 * radius, 0}, none, none), 0.25, 1e-12);
  EXPECT_EQ(obstacles.overlap({0, 4 * radius, 0}, none, none), 0);
}

TEST(Obstacles, OfNothingAreNowhere) {
  EXPECT_EQ(Obstacles({}, radius, {}).overlap({0, 0, 0}, none, none), 0);
}

RC_GTEST_PROP(Obstacles, AreFoundFromEverywhereAround, ()) {
  const auto coordinate = [] { return *rc::gen::inRange(-1000, 1000) * 1e-4; };
  const auto position = [&] { return Vector3d(coordinate(), coordinate(), coordinate()); };
  const Vector3d first = position();
  const Vector3d second = position();
  const Vector3d axis = position();
  const Obstacles obstacles({straight_fragment(first, second)}, radius, {});
  const double nearest = std::min((axis - first).norm(), (axis - second).norm());
  RC_ASSERT(std::abs(obstacles.overlap(axis, none, none) - std::max(0.0, 1 - nearest / (2 * radius))) <
            1e-12);
}

}  // namespace
}  // namespace tanglebin
