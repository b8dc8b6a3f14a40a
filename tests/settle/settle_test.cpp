#include "tanglebin/settle/settle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/settle/world.hpp"
#include "tests/settle/heaps.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::largest_motion;
using test::spawned_tubes;
using test::straight_tube;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Points of a tube's centre line, at most 2 mm apart.
std::vector<Vector3d> centre_line(const Tube& tube) {
  std::vector<Vector3d> points;
  for (const Edge& edge : tube.edges) {
    const Vector3d from = tube.nodes[edge.from].position;
    const Vector3d to = tube.nodes[edge.to].position;
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.002));
    for (int i = 0; i <= steps; ++i) points.emplace_back(from + (to - from) * i / steps);
  }
  return points;
}

// The distance of a point from a segment.
double distance(const Vector3d& point, const Capsule& capsule) {
  const Vector3d along = capsule.b - capsule.a;
  const double share = std::clamp((point - capsule.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - capsule.a - share * along).norm();
}

// Overlaps by points instead of closed forms, too small by at most (1 mm)² / 25 mm = 0.04 mm.
double sampled_tube_overlap(const std::vector<Tube>& tubes) {
  double deepest = 0;
  for (const Tube& tube : tubes) {
    for (const Vector3d& point : centre_line(tube)) {
      for (const Tube& other : tubes) {
        if (other.id == tube.id) continue;
        for (const Capsule& capsule : capsules(other)) {
          deepest = std::max(deepest, tube.radius + other.radius - distance(point, capsule));
        }
      }
    }
  }
  return deepest;
}

double sampled_bin_overlap(const std::vector<Tube>& tubes, const Bin& bin) {
  double deepest = 0;
  for (const Tube& tube : tubes) {
    for (const Vector3d& point : centre_line(tube)) {
      for (const Eigen::AlignedBox3d& box : boxes(bin)) {
        deepest = std::max(deepest, tube.radius - box.exteriorDistance(point));
      }
    }
  }
  return deepest;
}

// The mean of its cylinders, which is near the centre of mass.
Vector3d middle(const Tube& tube) {
  Vector3d sum = Vector3d::Zero();
  for (const Edge& edge : tube.edges) sum += frame_of(tube, edge).length * frame_of(tube, edge).centre;
  return sum / total_length(tube);
}

void expect_valid(const Settled& heap, const Bin& bin, const SettleSettings& settings = {}) {
  EXPECT_EQ(heap.fault, "");
  EXPECT_GT(heap.simulated, 0);
  EXPECT_LE(heap.simulated, settings.time_limit + settings.step);
  EXPECT_LE(heap.largest_overlap, settings.overlap_max);
  const double sampled = std::max(sampled_tube_overlap(heap.tubes), sampled_bin_overlap(heap.tubes, bin));
  EXPECT_LE(sampled, heap.largest_overlap + 1e-9);
  EXPECT_GE(sampled, heap.largest_overlap - 4e-5);
  for (const Tube& tube : heap.tubes) {
    EXPECT_LT(std::abs(middle(tube).x()), bin.length / 2) << "tube " << tube.id;
    EXPECT_LT(std::abs(middle(tube).y()), bin.width / 2) << "tube " << tube.id;
    EXPECT_GT(middle(tube).z(), 0) << "tube " << tube.id;
  }
}

bool are_identical(const Settled& first, const Settled& second) {
  const auto same_place = [](const Tube& a, const Tube& b) {
    return std::ranges::equal(a.nodes, b.nodes, {}, &Node::position, &Node::position);
  };
  return first.simulated == second.simulated && first.largest_overlap == second.largest_overlap &&
         first.fault == second.fault && std::ranges::equal(first.tubes, second.tubes, same_place);
}

TEST(Settle, AStraightTubeFallsFlatOnTheFloorWhereItWasDropped) {
  const SettleSettings settings;
  const Tube tube = straight_tube({-0.2, 0.05, 0.3}, {0.2, 0.05, 0.3});
  const Settled heap = settle({tube}, Bin{}, settings, 1);
  expect_valid(heap, Bin{});
  for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
    const Vector3d dropped = tube.nodes[i].position;
    const Vector3d position = heap.tubes[0].nodes[i].position;
    EXPECT_NEAR(position.z(), tube.radius - settings.surface_layer, 0.0001);
    EXPECT_LT((position - dropped).head<2>().norm(), 0.002);
  }
}

TEST(Settle, ABarWithFlatEndsLiesOnTheFloorFromEndToEnd) {
  const SettleSettings settings;
  Tube bar = straight_tube({-0.1, 0, 0.3}, {0.1, 0, 0.32});
  bar.flat_ends = true;
  const Settled heap = settle({bar}, Bin{}, settings, 1);
  EXPECT_EQ(heap.fault, "");
  EXPECT_TRUE(heap.tubes[0].flat_ends);
  for (const Node& node : heap.tubes[0].nodes)
    EXPECT_NEAR(node.position.z(), bar.radius - settings.surface_layer, 0.0001);
}

TEST(Settle, ATubeDroppedAcrossAnotherEndsClearOfIt) {
  const std::vector<Tube> tubes = {straight_tube({-0.2, 0, 0.02}, {0.2, 0, 0.02}, 1),
                                   straight_tube({0.03, -0.15, 0.25}, {0.03, 0.15, 0.25}, 2)};
  const Settled heap = settle(tubes, Bin{}, SettleSettings{}, 1);
  expect_valid(heap, Bin{});
  // One lies on the floor and the other still across it, at least one end off the floor.
  EXPECT_NEAR(middle(heap.tubes[0]).z(), tubes[0].radius, 0.0005);
  EXPECT_GT(middle(heap.tubes[1]).z(), 0.02);
}

TEST(Settle, SaysAtEachStepHowFarItIs) {
  const SettleSettings settings;
  const std::vector<Tube> tubes = spawned_tubes(1, 2, 30, Bin{});
  std::vector<double> times;
  const Settled heap =
      settle(tubes, Bin{}, settings, 1, [&](double simulated) { times.push_back(simulated); });
  EXPECT_TRUE(are_identical(heap, settle(tubes, Bin{}, settings, 1)));
  ASSERT_FALSE(times.empty());
  EXPECT_DOUBLE_EQ(times.front(), settings.step);
  EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST(Settle, IsEndedByWhatIsThrownAtAStep) {
  const auto stop = [](double simulated) {
    if (simulated > 0.1) throw std::runtime_error("stop");
  };
  EXPECT_THROW(settle(spawned_tubes(1, 2, 30, Bin{}), Bin{}, SettleSettings{}, 1, stop), std::runtime_error);
}

TEST(Settle, NoTubesAreAtRest) {
  const Settled heap = settle({}, Bin{}, SettleSettings{}, 1);
  EXPECT_EQ(heap.fault, "");
  EXPECT_TRUE(heap.tubes.empty());
  EXPECT_EQ(heap.largest_overlap, 0);
}

// How far heaps move that start again from where they rest: in a new world, with no damping.
double motion_from_rest(const std::vector<Tube>& heap, const Bin& bin, const SettleSettings& settings) {
  World world(heap, bin, settings, 99);
  while (world.time() < settings.proof_time) {
    world.step({.iterations = settings.iterations_max, .damping = 0});
  }
  return largest_motion(heap, world.tubes());
}

TEST(Settle, HeapsOfThePapersSetsAreValidAndRest) {
  const Bin bin;
  const SettleSettings settings;
  int attempts = 0;
  int valid = 0;
  int moved_on = 0;
  for (const double bend_max_deg : {30.0, 45.0}) {
    for (const int count : {1, 5, 10, 20}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(::testing::Message()
                     << count << " tubes, bends to " << bend_max_deg << ", seed " << seed);
        ++attempts;
        const Settled heap = settle(spawned_tubes(seed, count, bend_max_deg, bin), bin, settings, seed);
        if (!heap.fault.empty()) continue;
        ++valid;
        expect_valid(heap, bin);
        EXPECT_EQ(fault_of_heap(heap.tubes, bin, settings), "");
        const double motion = motion_from_rest(heap.tubes, bin, settings);
        EXPECT_LT(motion, 0.02);
        if (motion > settings.proof_motion) ++moved_on;
      }
    }
  }
  // Some are given up: a tube has bounced out or rocks on. Measured: 12 of 320.
  EXPECT_GE(valid, attempts * 3 / 4);
  // With the solver's rows in another order a few slip once more. Measured: 2 of 308 by more than the
  // proof's millimetre, one of them by 7 mm.
  EXPECT_LE(moved_on, 1);
}

TEST(Settle, SixtyTubesFindRestInThePublishedBin) {
  const Bin bin = bin_preset("published");
  Settled heap;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    heap = settle(spawned_tubes(seed, 60, 45, bin), bin, SettleSettings{}, seed);
    if (heap.fault.empty()) break;
  }
  ASSERT_EQ(heap.tubes.size(), 60U);
  expect_valid(heap, bin);
}

TEST(Settle, TheSameArgumentsGiveTheSameHeapWhateverCameBetween) {
  const std::vector<Tube> tubes = spawned_tubes(2, 10, 30, Bin{});
  const Settled first = settle(tubes, Bin{}, SettleSettings{}, 17);
  settle(spawned_tubes(1, 5, 45, Bin{}), Bin{}, SettleSettings{}, 5);
  EXPECT_TRUE(are_identical(settle(tubes, Bin{}, SettleSettings{}, 17), first));
}

TEST(Settle, AnotherSeedGivesAnotherHeap) {
  const std::vector<Tube> tubes = spawned_tubes(2, 10, 30, Bin{});
  const Settled first = settle(tubes, Bin{}, SettleSettings{}, 17);
  EXPECT_FALSE(are_identical(settle(tubes, Bin{}, SettleSettings{}, 18), first));
}

TEST(Settle, AHeapThatHasNoTimeIsGivenUpAsUnrested) {
  const SettleSettings settings = {.time_limit = 0.1};
  const Settled heap = settle(spawned_tubes(1, 5, 30, Bin{}), Bin{}, settings, 1);
  EXPECT_THAT(heap.fault, StartsWith("no rest"));
  EXPECT_NEAR(heap.simulated, 0.1, settings.step);
  EXPECT_EQ(heap.tubes.size(), 5U);
}

// A tube that rocks on by more than the proof allows, which is next to nothing.
TEST(Settle, AHeapThatFailsTheProofSaysHowFarItMoved) {
  const SettleSettings settings = {.proof_motion = 1e-12, .time_limit = 3};
  const Settled heap = settle(spawned_tubes(6, 1, 30, Bin{}), Bin{}, settings, 1);
  EXPECT_THAT(heap.fault, MatchesRegex("no rest: a node moved [0-9]+\\.[0-9][0-9] mm in 0\\.[0-9]+ s"));
}

TEST(FaultOfHeap, ATubeThatTopplesWhenItIsLetGoIsNotAtRest) {
  const double height = Bin{}.height;
  const Tube leaning = straight_tube({0, 0, 0.0124}, {0.02, 0, height}, 1);
  EXPECT_THAT(fault_of_heap({leaning}, Bin{}, SettleSettings{}), StartsWith("no rest: a node moved 1."));
  const Tube lying = straight_tube({-0.2, 0, 0.0124}, {0.2, 0, 0.0124}, 1);
  EXPECT_EQ(fault_of_heap({lying}, Bin{}, SettleSettings{}), "");
}

TEST(Settle, ATubeOutsideTheWallsHasLeftTheBin) {
  const Settled heap = settle({straight_tube({0.5, 0, 0.1}, {0.7, 0, 0.1})}, Bin{}, SettleSettings{}, 1);
  EXPECT_EQ(heap.fault, "a tube left the bin");
}

TEST(Settle, ATubeBalancedOnTheRimIsNotInTheBin) {
  const double x = Bin{}.length / 2 + Bin{}.wall / 2;
  const Settled heap =
      settle({straight_tube({x - 0.1, 0, 0.215}, {x + 0.1, 0, 0.215})}, Bin{}, SettleSettings{}, 1);
  EXPECT_EQ(heap.fault, "a centre of mass is outside the bin");
}

TEST(Settle, ABinTooSmallForItsTubesLosesThem) {
  const Bin bin = {.length = 0.1, .width = 0.1};
  EXPECT_EQ(settle(spawned_tubes(3, 5, 30, bin), bin, SettleSettings{}, 1).fault, "a tube left the bin");
}

// Less than what a resting contact keeps leaves no valid heap.
TEST(Settle, OverlapsThatAreTooDeepAreNamed) {
  const SettleSettings settings = {.overlap_max = 1e-6, .time_limit = 2};
  const Tube lying = straight_tube({-0.2, 0, 0.02}, {0.2, 0, 0.02}, 1);
  const Tube across = straight_tube({0, -0.1, 0.06}, {0, 0.1, 0.06}, 2);
  const Settled one = settle({lying}, Bin{}, settings, 1);
  EXPECT_THAT(one.fault, MatchesRegex("a tube overlaps the bin by 0\\.[01][0-9] mm"));
  EXPECT_NEAR(one.largest_overlap, settings.surface_layer, 2e-5);
  const Settled two = settle({lying, across}, Bin{}, settings, 1);
  EXPECT_THAT(two.fault, MatchesRegex("two tubes overlap by 0\\.[01][0-9] mm"));
}

TEST(Settle, ATubeWithoutMassIsRefused) {
  Tube tube = straight_tube({-0.1, 0, 0.1}, {0.1, 0, 0.1}, 3);
  tube.mass = 0;
  EXPECT_THROW(settle({tube}, Bin{}, SettleSettings{}, 1), InputError);
}

std::string complaint(const SettleSettings& settings) {
  return test::complaint([&] { validate(settings); });
}

TEST(SettleSettings, TheDefaultsAreValid) {
  EXPECT_EQ(complaint(SettleSettings{}), "none");
}

TEST(SettleSettings, LimitsThemselvesAreValid) {
  EXPECT_EQ(complaint({.friction = 0,
                       .step = 0.01,
                       .iterations = 1,
                       .iterations_max = 1,
                       .erp = 1,
                       .surface_layer = 0,
                       .correction_speed = 0,
                       .calm_damping = 0}),
            "none");
}

TEST(SettleSettings, WhatMustBeAPositiveNumberIsOne) {
  const std::vector<std::pair<double SettleSettings::*, std::string>> fields = {
      {&SettleSettings::gravity, "gravity"},           {&SettleSettings::calm_speed, "calm_speed"},
      {&SettleSettings::calm_time, "calm_time"},       {&SettleSettings::rest_speed, "rest_speed"},
      {&SettleSettings::rest_time, "rest_time"},       {&SettleSettings::proof_time, "proof_time"},
      {&SettleSettings::proof_motion, "proof_motion"}, {&SettleSettings::overlap_max, "overlap_max"},
      {&SettleSettings::time_limit, "time_limit"}};
  for (const auto& [member, name] : fields) {
    for (const auto& [value, text] :
         {std::pair{0.0, "0"}, {-1.5, "-1.5"}, {not_a_number, "nan"}, {infinity, "inf"}}) {
      SettleSettings settings;
      settings.*member = value;
      EXPECT_EQ(complaint(settings), "settle." + name + ": found " + text + ", expected a positive number");
    }
  }
}

TEST(SettleSettings, WhatMustNotBeNegativeIsNot) {
  const std::vector<std::pair<double SettleSettings::*, std::string>> fields = {
      {&SettleSettings::friction, "friction"},
      {&SettleSettings::surface_layer, "surface_layer"},
      {&SettleSettings::correction_speed, "correction_speed"}};
  for (const auto& [member, name] : fields) {
    for (const auto& [value, text] : {std::pair{-0.5, "-0.5"}, {not_a_number, "nan"}, {infinity, "inf"}}) {
      SettleSettings settings;
      settings.*member = value;
      EXPECT_EQ(complaint(settings),
                "settle." + name + ": found " + text + ", expected zero or a positive number");
    }
  }
}

TEST(SettleSettings, WhatHasARangeIsWithinIt) {
  EXPECT_EQ(complaint({.step = 0}), "settle.step: found 0, expected more than 0, at most 0.01 s");
  EXPECT_EQ(complaint({.step = 0.02}), "settle.step: found 0.02, expected more than 0, at most 0.01 s");
  EXPECT_EQ(complaint({.step = not_a_number}),
            "settle.step: found nan, expected more than 0, at most 0.01 s");
  EXPECT_EQ(complaint({.iterations = 0}), "settle.iterations: found 0, expected at least 1");
  EXPECT_EQ(complaint({.iterations = 50, .iterations_max = 49}),
            "settle.iterations_max: found 49, expected at least settle.iterations");
  EXPECT_EQ(complaint({.sor = 0}), "settle.sor: found 0, expected more than 0, less than 2");
  EXPECT_EQ(complaint({.sor = 2}), "settle.sor: found 2, expected more than 0, less than 2");
  EXPECT_EQ(complaint({.erp = -0.1}), "settle.erp: found -0.1, expected 0 to 1");
  EXPECT_EQ(complaint({.erp = 1.1}), "settle.erp: found 1.1, expected 0 to 1");
  EXPECT_EQ(complaint({.calm_damping = -0.1}), "settle.calm_damping: found -0.1, expected 0 to less than 1");
  EXPECT_EQ(complaint({.calm_damping = 1}), "settle.calm_damping: found 1, expected 0 to less than 1");
}

}  // namespace
}  // namespace tanglebin
