#include "tanglebin/geometry/nearest_axis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/geometry/any_point.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

using test::any_point;

std::vector<Capsule> any_capsules() {
  std::vector<Capsule> capsules;
  const int count = *rc::gen::inRange(1, 10);
  for (int i = 0; i < count; ++i) capsules.push_back({any_point(), any_point(), 0.01});
  return capsules;
}

RC_GTEST_PROP(NearestAxis, IsTheFirstOfTheNearestWhateverWasAskedBefore, ()) {
  const std::vector<Capsule> capsules = any_capsules();
  NearestAxis nearest(capsules);
  for (int i = 0; i < 20; ++i) {
    const Vector3d point = any_point();
    const Foot foot = nearest.foot_of(point);
    const auto first = std::ranges::min_element(
        capsules, {}, [&](const Capsule& capsule) { return axis_distance(capsule, point); });
    const Capsule& found = capsules[foot.capsule];
    RC_ASSERT(std::abs(axis_distance(found, point) - axis_distance(*first, point)) < 1e-12);
    RC_ASSERT(std::abs(foot.way.norm() - axis_distance(found, point)) < 1e-12);
    RC_ASSERT(foot.t == nearest_on_axis(found, point));
    RC_ASSERT(NearestAxis(capsules).foot_of(point).capsule == foot.capsule);
  }
}

// Beside the joint of two pieces, both are equally near.
TEST(NearestAxis, OfTwoThatMeetIsTheFirst) {
  NearestAxis nearest({{{0, 0, 0}, {1, 0, 0}, 0.1}, {{1, 0, 0}, {1, 1, 0}, 0.1}});
  EXPECT_EQ(nearest.foot_of({1, 2, 0}).capsule, 1U);
  const Foot foot = nearest.foot_of({2, -1, 0});
  EXPECT_EQ(foot.capsule, 0U);
  EXPECT_EQ(foot.t, 1);
  EXPECT_EQ(foot.way, Vector3d(1, -1, 0));
}

}  // namespace
}  // namespace tanglebin
