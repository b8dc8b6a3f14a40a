#include "tanglebin/settle/overlap.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/settle/heaps.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::straight_tube;

constexpr double radius = 0.0125;
constexpr double tight = 1e-9;

TEST(TubeOverlap, ParallelTubesOverlapByWhatTheirDistanceLacksOfADiameter) {
  const Tube first = straight_tube({0, 0, 0.1}, {0.3, 0, 0.1});
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0, 0.02, 0.1}, {0.3, 0.02, 0.1})}), 0.005, tight);
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0.1, 0, 0.124}, {0.2, 0, 0.124})}), 0.001, tight);
  EXPECT_EQ(largest_tube_overlap({first, straight_tube({0, 0.026, 0.1}, {0.3, 0.026, 0.1})}), 0);
}

TEST(TubeOverlap, CrossingTubesOverlapWhereTheyCross) {
  const Tube first = straight_tube({-0.2, 0, 0.1}, {0.2, 0, 0.1});
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0, -0.2, 0.12}, {0.1, 0.2, 0.12})}), 0.005, tight);
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0, -0.2, 0.1}, {0, 0.2, 0.1})}), 0.025, tight);
}

TEST(TubeOverlap, TouchingTubesDoNotOverlap) {
  const Tube first = straight_tube({0, 0, 0.1}, {0.3, 0, 0.1});
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0, 0.025, 0.1}, {0.3, 0.025, 0.1})}), 0, tight);
  EXPECT_NEAR(largest_tube_overlap({first, straight_tube({0.325, 0, 0.1}, {0.5, 0, 0.1})}), 0, tight);
}

TEST(TubeOverlap, BeyondAFlatEndThereIsNothingToOverlap) {
  const Tube other = straight_tube({0.31, 0, 0.1}, {0.5, 0, 0.1});
  Tube tube = straight_tube({0, 0, 0.1}, {0.3, 0, 0.1});
  EXPECT_NEAR(largest_tube_overlap({tube, other}), 0.015, tight);
  tube.flat_ends = true;
  EXPECT_NEAR(largest_tube_overlap({tube, other}), 0.0025, tight) << "the other end is round";
}

TEST(BinOverlap, ATubeMayStandOnAFlatEnd) {
  Tube tube = straight_tube({0, 0, 0}, {0, 0, 0.1});
  EXPECT_NEAR(largest_bin_overlap({tube}, Bin{}), radius, tight);
  tube.flat_ends = true;
  EXPECT_NEAR(largest_bin_overlap({tube}, Bin{}), 0, tight);
}

TEST(TubeOverlap, TheDeepestOfAllPairsCounts) {
  const Tube lowest = straight_tube({0, 0, 0.1}, {0.3, 0, 0.1});
  const Tube middle = straight_tube({0, 0, 0.124}, {0.3, 0, 0.124});
  const Tube highest = straight_tube({0, 0, 0.146}, {0.3, 0, 0.146});
  EXPECT_NEAR(largest_tube_overlap({lowest, middle, highest}), 0.003, tight);
  EXPECT_NEAR(largest_tube_overlap({highest, lowest, middle}), 0.003, tight);
  EXPECT_EQ(largest_tube_overlap({lowest, highest}), 0);
  EXPECT_EQ(largest_tube_overlap({lowest}), 0);
  EXPECT_EQ(largest_tube_overlap({}), 0);
}

TEST(TubeOverlap, ATubeDoesNotOverlapItself) {
  EXPECT_EQ(largest_tube_overlap({test::tube_through({{0, 0, 0.1}, {0.2, 0, 0.1}, {0, 0.01, 0.1}})}), 0);
}

TEST(BinOverlap, ATubeOnTheFloorOverlapsByWhatItsHeightLacksOfARadius) {
  EXPECT_NEAR(largest_bin_overlap({straight_tube({0, 0, 0.0123}, {0.2, 0, 0.0123})}, Bin{}), 0.0002, tight);
  EXPECT_NEAR(largest_bin_overlap({straight_tube({0, 0, 0.1}, {0.2, 0, 0.01})}, Bin{}), 0.0025, tight);
  EXPECT_NEAR(largest_bin_overlap({straight_tube({0, 0, radius}, {0.2, 0, radius})}, Bin{}), 0, tight);
  EXPECT_EQ(largest_bin_overlap({straight_tube({0, 0, 0.02}, {0.2, 0, 0.02})}, Bin{}), 0);
}

TEST(BinOverlap, EveryWallCounts) {
  const Bin bin;
  const double x = bin.length / 2 - 0.01;
  const double y = bin.width / 2 - 0.01;
  const double z = 0.1;
  for (const double side : {-1.0, 1.0}) {
    const Tube across_x = straight_tube({side * x, -0.1, z}, {side * x, 0.1, z});
    const Tube across_y = straight_tube({-0.1, side * y, z}, {0.1, side * y, z});
    EXPECT_NEAR(largest_bin_overlap({across_x}, bin), 0.0025, tight);
    EXPECT_NEAR(largest_bin_overlap({across_y}, bin), 0.0025, tight);
  }
}

TEST(BinOverlap, ATubeInAWallCountsWithItsRadius) {
  const Bin bin;
  const double middle = bin.length / 2 + bin.wall / 2;
  EXPECT_NEAR(largest_bin_overlap({straight_tube({middle, -0.1, 0.1}, {middle, 0.1, 0.1})}, bin), radius,
              tight);
  EXPECT_NEAR(largest_bin_overlap({straight_tube({0, 0, 0.1}, {0.5, 0, 0.1})}, bin), radius, tight);
}

TEST(BinOverlap, ATubeThatLeansOverTheRimOverlapsTheRimsEdge) {
  const Bin bin;
  const Vector3d edge(bin.length / 2, 0, bin.height);
  const Vector3d along = Vector3d(1, 0, 1).normalized();
  const Vector3d up = Vector3d(-1, 0, 1).normalized();
  for (const double depth : {0.0005, 0.004}) {
    const Vector3d over = edge + (radius - depth) * up;
    const Tube tube = straight_tube(over - 0.2 * along, over + 0.3 * along);
    EXPECT_NEAR(largest_bin_overlap({tube}, bin), depth, tight);
  }
}

TEST(BinOverlap, ATubeAboveTheBinOrBesideItOverlapsNothing) {
  const Bin bin;
  EXPECT_EQ(largest_bin_overlap({straight_tube({-0.5, 0, 0.22}, {0.5, 0, 0.22})}, bin), 0);
  EXPECT_EQ(largest_bin_overlap({straight_tube({0.4, 0, 0.1}, {0.5, 0, 0.1})}, bin), 0);
  EXPECT_EQ(largest_bin_overlap({}, bin), 0);
}

TEST(BinOverlap, TheDeepestTubeCountsWhateverItsPlace) {
  const Tube shallow = straight_tube({0, 0, 0.0123}, {0.2, 0, 0.0123});
  const Tube deep = straight_tube({0, 0.1, 0.0115}, {0.2, 0.1, 0.0115});
  EXPECT_NEAR(largest_bin_overlap({shallow, deep}, Bin{}), 0.001, tight);
  EXPECT_NEAR(largest_bin_overlap({deep, shallow}, Bin{}), 0.001, tight);
}

Vector3d point_around(Rng& rng, const Bin& bin) {
  return {uniform_real(rng, -bin.length, bin.length), uniform_real(rng, -bin.width, bin.width),
          uniform_real(rng, -bin.height / 2, 2 * bin.height)};
}

// The distance from a box changes along a line by no more than the way: so the nearest of many points on it
// is no farther than the nearest point of all and half their spacing.
RC_GTEST_PROP(BinOverlap, IsThatOfManyPointsOnTheCentreLine, (std::uint64_t seed)) {
  constexpr int points = 4000;
  const Bin bin;
  Rng rng(seed);
  const Vector3d from = point_around(rng, bin);
  const Vector3d to = point_around(rng, bin);
  double nearest = 1;
  for (int i = 0; i <= points; ++i) {
    const Vector3d point = from + (to - from) * i / points;
    for (const Eigen::AlignedBox3d& box : boxes(bin)) {
      nearest = std::min(nearest, (point - point.cwiseMax(box.min()).cwiseMin(box.max())).norm());
    }
  }
  const double sampled = std::max(0.0, radius - nearest);
  const double exact = largest_bin_overlap({straight_tube(from, to)}, bin);
  RC_ASSERT(exact >= sampled - tight);
  RC_ASSERT(exact <= sampled + (to - from).norm() / points / 2);
}

// The same for tubes of two bends.
RC_GTEST_PROP(TubeOverlap, IsThatOfManyPointsOnTheCentreLines, (std::uint64_t seed)) {
  constexpr int points = 60;
  Rng rng(seed);
  const auto corner = [&] {
    return Vector3d(uniform_real(rng, 0, 0.1), uniform_real(rng, 0, 0.1), uniform_real(rng, 0, 0.1));
  };
  const auto bent = [&] { return test::tube_through({corner(), corner(), corner()}); };
  const Tube first = bent();
  const Tube second = bent();
  const auto sample = [&](const Tube& tube) {
    std::vector<Vector3d> line;
    for (const Edge& edge : tube.edges) {
      const Vector3d from = tube.nodes[edge.from].position;
      const Vector3d to = tube.nodes[edge.to].position;
      for (int i = 0; i <= points; ++i) line.emplace_back(from + (to - from) * i / points);
    }
    return line;
  };
  double nearest = 1;
  const std::vector<Vector3d> others = sample(second);
  for (const Vector3d& point : sample(first)) {
    for (const Vector3d& other : others) nearest = std::min(nearest, (point - other).norm());
  }
  const double sampled = std::max(0.0, 2 * radius - nearest);
  const double exact = largest_tube_overlap({first, second});
  RC_ASSERT(exact >= sampled - tight);
  RC_ASSERT(exact <= sampled + 0.18 / points);  // an edge is at most 0.1 √3 m long; half a spacing on each
}

}  // namespace
}  // namespace tanglebin
