#include "tanglebin/model/axis/links/tube_shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tanglebin/base/constants.hpp"

namespace tanglebin {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::DoubleNear;
using testing::Ge;
using testing::Le;

constexpr double bar_radius = 0.006;  // m
constexpr double node_step = 0.004;   // m

// Straight pieces of 60 mm with round bends of 3 radii between them, in a plane.
CentrePath bent_bar(double first_bend, double second_bend) {
  CentrePath path{Vector3d::Zero()};
  double heading = 0;
  const auto go = [&](double length, double turn) {
    const int steps = static_cast<int>(std::lround(length / node_step));
    for (int i = 0; i < steps; ++i) {
      heading += turn / steps;
      path.push_back(path.back() + length / steps * Vector3d(std::cos(heading), std::sin(heading), 0));
    }
  };
  go(0.06, 0);
  go(3 * bar_radius * first_bend, first_bend);
  go(0.06, 0);
  go(3 * bar_radius * second_bend, second_bend);
  go(0.06, 0);
  return path;
}

CentrePath moved(const Isometry3d& pose, CentrePath path) {
  for (Vector3d& node : path) node = pose * node;
  return path;
}

const Isometry3d elsewhere = Translation3d(0.1, -0.2, 0.3) * AngleAxisd(2, Vector3d(1, 2, 3).normalized());

// Bends of 90 to 110 degrees.
TubeShapes bent_bars() {
  return {{bent_bar(90 * degree, 110 * degree), bent_bar(100 * degree, 100 * degree),
           moved(elsewhere, bent_bar(110 * degree, 90 * degree)), bent_bar(95 * degree, 95 * degree),
           bent_bar(105 * degree, 108 * degree)},
          bar_radius};
}

CentrePath part(const CentrePath& path, std::ptrdiff_t first, std::ptrdiff_t last) {
  return {path.begin() + first, path.begin() + last};
}

TEST(TubeShapes, WithoutAWholeTubeNothingIsStrange) {
  EXPECT_FALSE(TubeShapes().are_known());
  EXPECT_EQ(TubeShapes().strangeness(bent_bar(1, 2)), 0);
}

TEST(TubeShapes, ATubeIsNotStrangeWhereverItLiesAndWhicheverWayRound) {
  const TubeShapes shapes = bent_bars();
  ASSERT_TRUE(shapes.are_known());
  const CentrePath tube = bent_bar(97 * degree, 104 * degree);
  EXPECT_THAT(shapes.strangeness(tube), Le(1.5));
  EXPECT_THAT(shapes.strangeness(moved(elsewhere, tube)), DoubleNear(shapes.strangeness(tube), 1e-3));
  CentrePath mirrored = tube;
  for (Vector3d& node : mirrored) node.y() *= -1;
  EXPECT_THAT(shapes.strangeness(mirrored), DoubleNear(shapes.strangeness(tube), 1e-3));
  CentrePath reversed = tube;
  std::ranges::reverse(reversed);
  EXPECT_THAT(shapes.strangeness(reversed), Le(1.5));
}

TEST(TubeShapes, NoPartOfATubeIsStrange) {
  const TubeShapes shapes = bent_bars();
  const CentrePath tube = moved(elsewhere, bent_bar(100 * degree, 95 * degree));
  const auto size = static_cast<std::ptrdiff_t>(tube.size());
  for (const std::ptrdiff_t length : {4, 10, 20, 35}) {
    for (std::ptrdiff_t first = 0; first + length <= size; first += 3)
      EXPECT_THAT(shapes.strangeness(part(tube, first, first + length)), Le(1.5)) << first << ' ' << length;
  }
}

// What no bar has: 0.15 m without a bend, a bend of the wrong angle, two bends to different sides.
TEST(TubeShapes, WhatNoTubeHasIsStrange) {
  const TubeShapes shapes = bent_bars();
  CentrePath straight;
  for (int i = 0; i < 38; ++i) straight.emplace_back(i * node_step, 0, 0);
  EXPECT_THAT(shapes.strangeness(straight), Ge(2.5));
  EXPECT_THAT(shapes.strangeness(bent_bar(60 * degree, 100 * degree)), Ge(2.5));
  EXPECT_THAT(shapes.strangeness(bent_bar(100 * degree, -100 * degree)), Ge(2.5));
}

TEST(TubeShapes, TubesThatAreNotAlikeHaveNoShape) {
  EXPECT_FALSE(TubeShapes({bent_bar(0, 0), bent_bar(60 * degree, 0), bent_bar(100 * degree, 100 * degree),
                           bent_bar(100 * degree, -100 * degree)},
                          bar_radius)
                   .are_known());
}

TEST(TubeShapes, TwoTubesAreTooFew) {
  EXPECT_FALSE(
      TubeShapes({bent_bar(100 * degree, 100 * degree), bent_bar(100 * degree, 100 * degree)}, bar_radius)
          .are_known());
}

// A false tube that was taken for a whole one is not like the others.
TEST(TubeShapes, ATubeThatIsLikeNoOtherDoesNotCount) {
  const TubeShapes shapes({bent_bar(90 * degree, 110 * degree), bent_bar(100 * degree, 100 * degree),
                           bent_bar(105 * degree, 95 * degree), bent_bar(0, 0)},
                          bar_radius);
  ASSERT_TRUE(shapes.are_known());
  EXPECT_THAT(shapes.strangeness(bent_bar(0, 0)), Ge(2.5));
}

TEST(PathLength, IsTheSumOfTheEdges) {
  EXPECT_THAT(path_length(bent_bar(1, 1)), DoubleNear(0.18 + 6 * bar_radius, 1e-9));
}

}  // namespace
}  // namespace tanglebin
