#include "tanglebin/geometry/capsule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/geometry/any_point.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::any_point;

// Points of a fine grid: segments in general position.
Vector3d any_fine_point() {
  const auto coordinate = rc::gen::inRange(-1000000, 1000001);
  return Vector3d(*coordinate, *coordinate, *coordinate) / 1e6;
}

Vector3d at(const Vector3d& a, const Vector3d& b, double parameter) {
  return a + parameter * (b - a);
}

// No sampled pair of points comes closer than the closest points, and some come nearly as close.
void expect_closest(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0, const Vector3d& q1) {
  const SegmentPair closest = closest_points(p0, p1, q0, q1);
  RC_ASSERT(closest.s >= 0 && closest.s <= 1 && closest.t >= 0 && closest.t <= 1);
  RC_ASSERT(std::abs((at(p0, p1, closest.s) - at(q0, q1, closest.t)).norm() - closest.distance) < 1e-12);

  constexpr int steps = 64;
  double sampled = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(i) / steps;
      const double t = static_cast<double>(k) / steps;
      sampled = std::min(sampled, (at(p0, p1, s) - at(q0, q1, t)).norm());
    }
  }
  const double half_a_step = ((p1 - p0).norm() + (q1 - q0).norm()) / steps / 2;
  RC_ASSERT(closest.distance <= sampled + 1e-9);
  RC_ASSERT(closest.distance >= sampled - half_a_step - 1e-9);
}

RC_GTEST_PROP(ClosestPoints, AreCloserThanAnyOthersOnAGrid, ()) {
  expect_closest(any_point(), any_point(), any_point(), any_point());
}

RC_GTEST_PROP(ClosestPoints, AreCloserThanAnyOthersInGeneralPosition, ()) {
  expect_closest(any_fine_point(), any_fine_point(), any_fine_point(), any_fine_point());
}

RC_GTEST_PROP(ClosestPoints, OfNearlyParallelSegmentsAreClosest, ()) {
  const Vector3d p0 = any_fine_point();
  const Vector3d p1 = any_fine_point();
  const Vector3d offset = any_fine_point();
  const double tilt = *rc::gen::element(0.0, 1e-12, 1e-9, 1e-7, 1e-5);
  expect_closest(p0, p1, p0 + offset, p1 + offset + tilt * any_fine_point());
}

RC_GTEST_PROP(ClosestPoints, AreTheSameEitherWayRound, ()) {
  const Vector3d p0 = any_fine_point();
  const Vector3d p1 = any_fine_point();
  const Vector3d q0 = any_fine_point();
  const Vector3d q1 = any_fine_point();
  const double distance = closest_points(p0, p1, q0, q1).distance;
  RC_ASSERT(std::abs(closest_points(q0, q1, p0, p1).distance - distance) < 1e-9);
  RC_ASSERT(std::abs(closest_points(p1, p0, q0, q1).distance - distance) < 1e-9);
}

TEST(ClosestPoints, OfCrossingSegmentsLieInsideBoth) {
  const SegmentPair closest = closest_points({-1, 0, 0}, {1, 0, 0}, {0, -1, 0.5}, {0, 3, 0.5});
  EXPECT_DOUBLE_EQ(closest.distance, 0.5);
  EXPECT_DOUBLE_EQ(closest.s, 0.5);
  EXPECT_DOUBLE_EQ(closest.t, 0.25);
}

TEST(ClosestPoints, OfParallelSegmentsSideBySideFaceEachOther) {
  const SegmentPair closest = closest_points({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {3, 1, 0});
  EXPECT_DOUBLE_EQ(closest.distance, 1);
  EXPECT_DOUBLE_EQ(2 * closest.s, 1 + 2 * closest.t);
}

TEST(ClosestPoints, OfSegmentsInALineAreTheirNearEnds) {
  const SegmentPair closest = closest_points({0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {3, 0, 0});
  EXPECT_DOUBLE_EQ(closest.distance, 2);
  EXPECT_DOUBLE_EQ(closest.s, 1);
  EXPECT_DOUBLE_EQ(closest.t, 1);
}

TEST(ClosestPoints, OfAPointAndASegmentIsTheFootOfThePerpendicular) {
  const Vector3d point(1, 2, 0);
  const SegmentPair closest = closest_points(point, point, {0, 0, 0}, {4, 0, 0});
  EXPECT_DOUBLE_EQ(closest.distance, 2);
  EXPECT_DOUBLE_EQ(closest.t, 0.25);
}

TEST(ClosestPoints, OfTwoPointsAreThePoints) {
  EXPECT_DOUBLE_EQ(closest_points({0, 0, 0}, {0, 0, 0}, {3, 4, 0}, {3, 4, 0}).distance, 5);
}

TEST(AxisDistance, IsThatOfTheNearestPointOfTheAxis) {
  const Capsule capsule{{0, 0, 0}, {4, 0, 0}, 0.1};
  EXPECT_DOUBLE_EQ(axis_distance(capsule, {1, 2, 0}), 2);
  EXPECT_DOUBLE_EQ(nearest_on_axis(capsule, {1, 2, 0}), 0.25);
  EXPECT_DOUBLE_EQ(axis_distance(capsule, {7, 4, 0}), 5) << "beyond its end";
  EXPECT_DOUBLE_EQ(axis_distance({{1, 1, 1}, {1, 1, 1}, 0.1}, {1, 1, 3}), 2) << "a sphere";
}

TEST(SurfaceDistance, IsWhatTheRadiiLeaveOfTheDistance) {
  const Capsule first{{0, 0, 0}, {1, 0, 0}, 0.1};
  EXPECT_DOUBLE_EQ(surface_distance(first, {{0, 1, 0}, {1, 1, 0}, 0.3}), 0.6);
}

TEST(SurfaceDistance, IsNegativeByTheDepthOfOverlap) {
  const Capsule first{{0, 0, 0}, {1, 0, 0}, 0.1};
  EXPECT_NEAR(surface_distance(first, {{0.5, 0.15, -1}, {0.5, 0.15, 1}, 0.1}), -0.05, 1e-15);
}

TEST(Rounded, EndsWhereTheFlatEndsAre) {
  const Capsule flat{.a = {0, 0, 0}, .b = {1, 0, 0}, .radius = 0.1, .flat_at_a = true};
  const Capsule round = rounded(flat);
  EXPECT_TRUE(round.a.isApprox(Eigen::Vector3d(0.1, 0, 0)));
  EXPECT_EQ(round.b, flat.b);
  EXPECT_FALSE(round.flat_at_a);
}

TEST(Rounded, LeavesACapsuleWithRoundEndsAsItIs) {
  const Capsule capsule{.a = {0, 0, 0}, .b = {1, 0, 0}, .radius = 0.1};
  EXPECT_EQ(rounded(capsule).a, capsule.a);
  EXPECT_EQ(rounded(capsule).b, capsule.b);
}

TEST(Rounded, ShrinksAShortOneToASphere) {
  const Capsule disc{.a = {0, 0, 0}, .b = {0.1, 0, 0}, .radius = 0.1, .flat_at_a = true, .flat_at_b = true};
  EXPECT_TRUE(rounded(disc).a.isApprox(Eigen::Vector3d(0.05, 0, 0)));
  EXPECT_TRUE(rounded(disc).b.isApprox(Eigen::Vector3d(0.05, 0, 0)));
}

}  // namespace
}  // namespace tanglebin
