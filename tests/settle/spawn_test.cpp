#include "tanglebin/settle/spawn.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/settle/heaps.hpp"
#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::drawn_tubes;
using test::radians;
using test::spawned_tubes;
using test::straight_tube;

double least_distance(const Tube& first, const Tube& second) {
  double least = 1e9;
  for (const Capsule& a : capsules(first)) {
    for (const Capsule& b : capsules(second)) least = std::min(least, surface_distance(a, b));
  }
  return least;
}

double least_distance(const std::vector<Tube>& tubes) {
  double least = 1e9;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, least_distance(tubes[i], tubes[j]));
  }
  return least;
}

// Of the line between the two nodes farthest apart, rad.
double slope(const Tube& tube) {
  Vector3d axis = Vector3d::Zero();
  for (const Node& first : tube.nodes) {
    for (const Node& second : tube.nodes) {
      const Vector3d line = first.position - second.position;
      if (line.norm() > axis.norm()) axis = line;
    }
  }
  return std::asin(std::abs(axis.z()) / axis.norm());
}

bool fits_the_opening(const Tube& tube, const Bin& bin) {
  const Eigen::AlignedBox3d box = bounds(tube);
  return box.min().x() >= -bin.length / 2 - 1e-12 && box.max().x() <= bin.length / 2 + 1e-12 &&
         box.min().y() >= -bin.width / 2 - 1e-12 && box.max().y() <= bin.width / 2 + 1e-12;
}

TEST(Spawn, TubesAreClearOfEachOtherAndOfTheRim) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Bin bin;
    const std::vector<Tube> tubes = spawned_tubes(seed, 20, 45, bin);
    EXPECT_GT(least_distance(tubes), 0.0019) << "seed " << seed;
    for (const Tube& tube : tubes) EXPECT_GT(bounds(tube).min().z(), bin.height) << "seed " << seed;
  }
}

TEST(Spawn, TheFirstTubeIsJustOverTheRim) {
  const Bin bin;
  EXPECT_NEAR(bounds(spawned_tubes(1, 1, 30, bin)[0]).min().z(), bin.height + 0.002, 1e-9);
}

TEST(Spawn, TheOutlineOfEveryTubeIsWithinTheOpening) {
  for (const char* name : {"paper", "published"}) {
    const Bin bin = bin_preset(name);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      for (const Tube& tube : spawned_tubes(seed, 10, 30, bin)) {
        EXPECT_TRUE(fits_the_opening(tube, bin)) << name << " bin, seed " << seed << ", tube " << tube.id;
      }
    }
  }
}

TEST(Spawn, ATubeLongerThanTheBinLiesDiagonallyWhereThatFits) {
  const Bin bin;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    std::vector<Tube> tubes = {straight_tube({0, 0, 0}, {0, 0.56, 0})};  // the bin is 0.55 m long
    spawn(rng, tubes, bin);
    EXPECT_TRUE(fits_the_opening(tubes[0], bin)) << "seed " << seed;
  }
}

TEST(Spawn, ATubeThatDoesNotFitIsCentredOverTheBin) {
  const Bin bin = {.length = 0.2, .width = 0.2};
  Rng rng(1);
  std::vector<Tube> tubes = {straight_tube({0, 0, 0}, {0.5, 0, 0})};
  spawn(rng, tubes, bin);
  const Vector3d centre = bounds(tubes[0]).center();
  EXPECT_LT(centre.head<2>().norm(), 1e-12);
  // And it lies along a diagonal more or less, where it hangs over least.
  const Eigen::Vector2d along = (tubes[0].nodes[1].position - tubes[0].nodes[0].position).head<2>();
  EXPECT_NEAR(std::abs(along.x() / along.y()), 1, 0.2);
}

TEST(Spawn, ASteepTubeIsLoweredTo45DegreesAndAGentleOneKeepsItsTilt) {
  Rng rng(1);
  for (const double tilt_deg : {0.0, 20.0, 44.0, 46.0, 70.0, 90.0}) {
    const double tilt = radians(tilt_deg);
    std::vector<Tube> tubes = {straight_tube({0, 0, 0}, 0.3 * Vector3d(std::cos(tilt), 0, std::sin(tilt))),
                               straight_tube(0.3 * Vector3d(0, std::cos(tilt), std::sin(tilt)), {0, 0, 0})};
    spawn(rng, tubes, Bin{});
    for (const Tube& tube : tubes) EXPECT_NEAR(slope(tube), radians(std::min(45.0, tilt_deg)), 1e-9);
  }
}

TEST(Spawn, NoDrawnTubeIsSteeperThan45Degrees) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const Tube& tube : spawned_tubes(seed, 10, 45, Bin{})) {
      EXPECT_LE(slope(tube), std::numbers::pi / 4 + 1e-9) << "seed " << seed << ", tube " << tube.id;
    }
  }
}

double node_distance(const Tube& tube, std::size_t a, std::size_t b) {
  return (tube.nodes[a].position - tube.nodes[b].position).norm();
}

TEST(Spawn, ATubeIsMovedAsARigidBody) {
  Rng rng(5);
  const std::vector<Tube> before = drawn_tubes(rng, 10, 45);
  std::vector<Tube> after = before;
  spawn(rng, after, Bin{});
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].id, before[i].id);
    for (std::size_t a = 0; a < before[i].nodes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_NEAR(node_distance(after[i], a, b), node_distance(before[i], a, b), 1e-12);
      }
    }
  }
}

TEST(Spawn, PlacesAreUniformOverWhatTheOpeningLeavesFree) {
  const Bin bin;
  const double free = (bin.length - 0.025) / 2;
  Rng rng(6);
  std::vector<double> places;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Tube> tubes = {straight_tube({0, 0, 0}, {0, 0.1, 0})};  // it fits as it is
    spawn(rng, tubes, bin);
    places.push_back(bounds(tubes[0]).center().x());
  }
  EXPECT_GT(test::uniform_p(places, -free, free), test::significance);
}

TEST(Spawn, AHundredTubesArePlacedToo) {
  const Bin bin;
  const std::vector<Tube> tubes = spawned_tubes(1, 100, 45, bin);
  EXPECT_GT(least_distance(tubes), 0.0019);
  // Low enough not to fall for long: measured, 2.6 m.
  for (const Tube& tube : tubes) EXPECT_LT(bounds(tube).max().z(), 4);
}

TEST(Spawn, TheSameGeneratorGivesTheSamePlacesAndAnotherOneOthers) {
  const std::vector<Tube> first = spawned_tubes(1, 20, 30, Bin{});
  EXPECT_EQ(test::largest_motion(first, spawned_tubes(1, 20, 30, Bin{})), 0);

  Rng rng(1);
  Rng other(2);
  const std::vector<Tube> drawn = drawn_tubes(rng, 2, 0);
  std::vector<Tube> here = drawn;
  std::vector<Tube> there = drawn;
  spawn(rng, here, Bin{});
  spawn(other, there, Bin{});
  EXPECT_NE(here[0].nodes[0].position, there[0].nodes[0].position);
}

TEST(Spawn, NoTubesAreNoWork) {
  Rng rng(1);
  std::vector<Tube> none;
  EXPECT_NO_THROW(spawn(rng, none, Bin{}));
}

}  // namespace
}  // namespace tanglebin
