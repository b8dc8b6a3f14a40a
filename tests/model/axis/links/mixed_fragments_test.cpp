#include "tanglebin/model/axis/links/mixed_fragments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tanglebin/base/constants.hpp"
#include "tests/model/axis/links/bent_bar.hpp"

namespace tanglebin {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::SizeIs;

using test::bar_radius;
using test::bent_bar;
using test::equal_bars;
using test::moved;

const CentrePath bar = bent_bar(100 * degree, 100 * degree);

// Votes along a bar, with the normals of its upper half. The bars lie flat.
void add_bar(AxisVotes& votes, const CentrePath& path) {
  constexpr int between = 20;
  constexpr int around = 7;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3d step = path[i] - path[i - 1];
    const Vector3d side = step.cross(Vector3d::UnitZ()).normalized();
    for (int j = 0; j < between; ++j) {
      const double angle = std::numbers::pi * (j % around + 1) / (around + 1);
      votes.votes.push_back((path[i - 1] + step * j / between).cast<float>());
      votes.normals.push_back((std::cos(angle) * side + std::sin(angle) * Vector3d::UnitZ()).cast<float>());
    }
  }
}

// A bar whose end meets the end of another one, which goes straight on.
AxisVotes two_bars_in_line() {
  AxisVotes votes;
  add_bar(votes, bar);
  const Vector3d outward = (bar[0] - bar[1]).normalized();
  const CentrePath other = moved(
      Isometry3d(Translation3d(bar[0] + 0.001 * outward)) * AngleAxisd(std::numbers::pi, Vector3d::UnitZ()),
      bar);
  add_bar(votes, other);
  return votes;
}

std::vector<Fragment> bar_fragments(const AxisVotes& votes) {
  return find_fragments(votes, bar_radius, false, {});
}

bool cut_bars(std::vector<Fragment>& fragments, const AxisVotes& votes, const TubeShapes& shapes) {
  return cut_mixed(fragments, votes, bar_radius, shapes, {});
}

void expect_one_that_stays_whole(const AxisVotes& votes, const TubeShapes& shapes) {
  std::vector<Fragment> found = bar_fragments(votes);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(cut_bars(found, votes, shapes));
  EXPECT_THAT(found, SizeIs(1));
}

TEST(MixedFragments, AreCutWhereTheTubesMeet) {
  const AxisVotes votes = two_bars_in_line();
  std::vector<Fragment> found = bar_fragments(votes);
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_TRUE(cut_bars(found, votes, equal_bars()));
  ASSERT_THAT(found, SizeIs(2));
  std::size_t points = 0;
  for (const Fragment& fragment : found) {
    EXPECT_NEAR(fragment.length, path_length(bar), 3 * bar_radius);
    ASSERT_THAT(fragment.ends, SizeIs(2));
    EXPECT_TRUE(std::ranges::is_sorted(fragment.points));
    const auto is_near = [&](const FragmentEnd& end) {
      return (end.position - bar[0]).norm() < 2 * bar_radius && std::abs(end.outward.x()) > 0.95;
    };
    EXPECT_EQ(std::ranges::count_if(fragment.ends, is_near), 1) << "where the bars meet";
    points += fragment.points.size();
  }
  EXPECT_GE(points, votes.votes.size() - 30) << "only the joint is left out";
  EXPECT_FALSE(cut_bars(found, votes, equal_bars())) << "neither is mixed";
}

TEST(MixedFragments, NoTubeIsCut) {
  AxisVotes votes;
  add_bar(votes, bar);
  expect_one_that_stays_whole(votes, equal_bars());
}

// A bar that is bent otherwise is not mended by a cut.
TEST(MixedFragments, WhatHasNoOrdinaryPartsStaysWhole) {
  CentrePath circle;
  constexpr int nodes = 60;
  for (int i = 0; i <= nodes; ++i) {
    const double angle = 1.5 * std::numbers::pi * i / nodes;
    circle.emplace_back(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0);
  }
  AxisVotes votes;
  add_bar(votes, circle);
  expect_one_that_stays_whole(votes, equal_bars());
}

TEST(MixedFragments, AreNotCutWhereNoShapeIsKnown) {
  expect_one_that_stays_whole(two_bars_in_line(), TubeShapes());
}

// A hose and a longer one: nothing tells where one of them ends.
TEST(MixedFragments, AreNotCutWhereTubesAreNotBent) {
  const CentrePath hose = bent_bar(8 * degree, 8 * degree);
  const TubeShapes hoses({hose, hose, hose}, bar_radius);
  ASSERT_TRUE(hoses.are_known());
  expect_one_that_stays_whole(two_bars_in_line(), hoses);
}

}  // namespace
}  // namespace tanglebin
