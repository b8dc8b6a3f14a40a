#include "tanglebin/model/axis/links/tube_shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tanglebin/base/constants.hpp"
#include "tests/model/axis/links/bent_bar.hpp"

namespace tanglebin {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::DoubleNear;
using testing::Ge;
using testing::Le;

using test::bar_radius;
using test::bent_bar;
using test::equal_bars;
using test::moved;
using test::node_step;

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

// Bent ones are not alike by chance.
TEST(TubeShapes, TwoBarsThatAreVeryMuchAlikeAreEnough) {
  const CentrePath bar = bent_bar(100 * degree, 100 * degree);
  const CentrePath straight = bent_bar(0, 0);
  const CentrePath other = bent_bar(30 * degree, 60 * degree);
  const TubeShapes shapes({straight, bar, other, moved(elsewhere, bar), bent_bar(0, 120 * degree)},
                          bar_radius);
  EXPECT_TRUE(shapes.are_bent());
  EXPECT_THAT(shapes.strangeness(bar), Le(1.5));
  EXPECT_THAT(shapes.strangeness(straight), Ge(2.5));
  EXPECT_THAT(shapes.strangeness(other), Ge(2.5));
  EXPECT_FALSE(TubeShapes({bar, bent_bar(120 * degree, 80 * degree)}, bar_radius).are_known())
      << "a little alike";
}

TEST(TubeShapes, TwoHosesAreTooFew) {
  const CentrePath hose = bent_bar(8 * degree, 8 * degree);
  EXPECT_FALSE(TubeShapes({hose, hose}, bar_radius).are_known());
  EXPECT_FALSE(TubeShapes({hose}, bar_radius).are_known());
  EXPECT_FALSE(TubeShapes({}, bar_radius).are_known());
}

// A false tube that was taken for a whole one is not like the others.
TEST(TubeShapes, ATubeThatIsLikeNoOtherDoesNotCount) {
  const TubeShapes shapes({bent_bar(90 * degree, 110 * degree), bent_bar(100 * degree, 100 * degree),
                           bent_bar(105 * degree, 95 * degree), bent_bar(0, 0)},
                          bar_radius);
  ASSERT_TRUE(shapes.are_known());
  EXPECT_THAT(shapes.strangeness(bent_bar(0, 0)), Ge(2.5));
}

TEST(TubeShapes, BarsAreBentAndHosesAreNot) {
  EXPECT_TRUE(bent_bars().are_bent());
  const CentrePath hose = bent_bar(8 * degree, 8 * degree);
  const TubeShapes hoses({hose, bent_bar(10 * degree, 8 * degree), bent_bar(8 * degree, 4 * degree)},
                         bar_radius);
  ASSERT_TRUE(hoses.are_known());
  EXPECT_FALSE(hoses.are_bent());
  EXPECT_FALSE(TubeShapes().are_bent());
}

double distance_from(const CentrePath& path, const Vector3d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& node : path) least = std::min(least, (node - place).norm());
  return least;
}

double farthest_from(const CentrePath& path, const CentrePath& places) {
  double most = 0;
  for (const Vector3d& place : places) most = std::max(most, distance_from(path, place));
  return most;
}

// The best one first.
std::vector<TubeShapes::Laid> laid_on(const TubeShapes& shapes, const CentrePath& part) {
  std::vector<TubeShapes::Laid> ways;
  shapes.lay_on(part, [&](const TubeShapes::Laid& laid) {
    ways.push_back(laid);
    return true;
  });
  std::ranges::stable_sort(ways, {}, &TubeShapes::Laid::strangeness);
  return ways;
}

// One end and the bend after it say where the other end is.
TEST(TubeShapes, ABentPartShowsWhereTheRestIs) {
  const TubeShapes shapes = equal_bars();
  const CentrePath bar = moved(elsewhere, bent_bar(100 * degree, 100 * degree));
  const TubeShapes::Laid laid = laid_on(shapes, part(bar, 0, 30)).front();
  EXPECT_THAT(laid.strangeness, Le(1.5));
  const CentrePath rest = shapes.rest_of(laid, 0);
  EXPECT_THAT(TubeShapes::step * bar_radius * static_cast<double>(rest.size()), DoubleNear(0.1, 0.03));
  EXPECT_THAT(farthest_from(bar, rest), Le(bar_radius));
  EXPECT_THAT(shapes.rest_of(laid, 0.02).size(), testing::Lt(rest.size()));
  EXPECT_THAT(shapes.rest_of(laid_on(shapes, bar).front(), 0), testing::IsEmpty());
}

// A straight part may be any of the straight pieces, and the rest may be all around it: one of the ways is
// true.
TEST(TubeShapes, OnAStraightPartATubeIsTurned) {
  const TubeShapes shapes = equal_bars();
  const CentrePath bar = moved(elsewhere, bent_bar(100 * degree, 100 * degree));
  const std::vector<TubeShapes::Laid> laid = laid_on(shapes, part(bar, 0, 12));
  EXPECT_THAT(laid.size(), Ge(16U));
  double least = std::numeric_limits<double>::infinity();
  for (const TubeShapes::Laid& way : laid)
    least = std::min(least, farthest_from(bar, shapes.rest_of(way, 0)));
  EXPECT_THAT(least, Le(5 * bar_radius));
}

TEST(TubeShapes, NoMoreWaysAreTriedThanAskedFor) {
  int visits = 0;
  equal_bars().lay_on(bent_bar(100 * degree, 100 * degree),
                      [&](const TubeShapes::Laid& /*laid*/) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

// The way over a gap is measured straight ahead, which is too short where a bend is hidden.
TEST(TubeShapes, AHiddenBendIsNotStrange) {
  const TubeShapes shapes = equal_bars();
  const CentrePath bar = bent_bar(100 * degree, 100 * degree);
  CentrePath gaped = part(bar, 0, 12);
  const CentrePath behind = part(bar, 26, static_cast<std::ptrdiff_t>(bar.size()));
  gaped.insert(gaped.end(), behind.begin(), behind.end());
  EXPECT_THAT(shapes.strangeness(gaped), Ge(2.5));
  EXPECT_THAT(laid_on(shapes, gaped).front().strangeness, Le(1.5));
}

TEST(PathLength, IsTheSumOfTheEdges) {
  EXPECT_THAT(path_length(bent_bar(1, 1)), DoubleNear(0.18 + 6 * bar_radius, 1e-9));
}

}  // namespace
}  // namespace tanglebin
