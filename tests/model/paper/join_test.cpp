#include "tanglebin/model/paper/join.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>

#include "tanglebin/base/random.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

Cylinder piece(const Vector3d& a, const Vector3d& b) {
  return {.ends = {a, b}, .points = {}};
}

Camera papers_camera() {
  return camera_preset("paper");
}

// Something above the whole bin: no way between ends is seen to be empty.
RangeImage lid() {
  PointCloud cloud;
  for (float x = -0.4F; x < 0.4F; x += 0.001F) {
    for (float y = -0.3F; y < 0.3F; y += 0.001F) cloud.points.emplace_back(x, y, 0.6F);
  }
  return {cloud.points, papers_camera()};
}

RangeImage nothing_seen() {
  return {{}, papers_camera()};
}

TEST(JoinMeasures, AreDistanceAndTurnsOfTheFormula) {
  // In line: outward at p1, v, and inward at p2 all point along x.
  const Cylinder left = piece({-0.1, 0, 0.1}, {0, 0, 0.1});
  const Cylinder right = piece({0.03, 0, 0.1}, {0.1, 0, 0.1});
  const JoinMeasures in_line = measure_join(left, 1, right, 0);
  EXPECT_NEAR(in_line.distance, 0.03, 1e-12);
  EXPECT_NEAR(in_line.angle, 0, 1e-12);
  // From the far ends everything points the other way: each turns by half a circle.
  EXPECT_NEAR(measure_join(left, 0, right, 1).angle, 2 * std::numbers::pi, 1e-12);
  // A right angle at the second cylinder only.
  const Cylinder up = piece({0.03, 0, 0.1}, {0.03, 0, 0.2});
  EXPECT_NEAR(measure_join(left, 1, up, 0).angle, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(measure_join(up, 0, left, 1).angle, std::numbers::pi / 2, 1e-12) << "either way round";
}

TEST(JoinCylinders, JoinsThePiecesOfATubeUnderSomething) {
  const std::vector<Cylinder> pieces = {piece({-0.2, 0, 0.1}, {-0.05, 0, 0.1}),
                                        piece({0.05, 0.01, 0.1}, {0.2, 0.02, 0.1})};
  const std::vector<Join> joins = join_cylinders(pieces, lid(), 0.5, {});
  ASSERT_EQ(joins.size(), 1U);
  EXPECT_EQ(joins[0].ends[0].end, 1U);
  EXPECT_EQ(joins[0].ends[1].end, 0U);
  EXPECT_GT(joins[0].cost, 0.1);
}

TEST(JoinCylinders, JoinsNothingAcrossSpaceThatIsSeenToBeEmpty) {
  const std::vector<Cylinder> pieces = {piece({-0.2, 0, 0.1}, {-0.05, 0, 0.1}),
                                        piece({0.05, 0, 0.1}, {0.2, 0, 0.1})};
  EXPECT_TRUE(join_cylinders(pieces, nothing_seen(), 0.5, {}).empty());
}

TEST(JoinCylinders, MakesNoTubeLongerThanTheKnownLength) {
  const std::vector<Cylinder> pieces = {piece({-0.25, 0, 0.1}, {-0.1, 0, 0.1}),
                                        piece({-0.08, 0, 0.1}, {0.1, 0, 0.1}),
                                        piece({0.12, 0, 0.1}, {0.25, 0, 0.1})};
  EXPECT_EQ(join_cylinders(pieces, lid(), 0.5, {}).size(), 2U);
  EXPECT_EQ(join_cylinders(pieces, lid(), 0.4, {}).size(), 1U);
  EXPECT_EQ(join_cylinders(pieces, lid(), 0.3, {}).size(), 0U);
}

TEST(JoinCylinders, TakesTheCheapestPairFirst) {
  // The middle piece could go on to either; the one in line is cheaper than the one that is nearer but aside.
  const std::vector<Cylinder> pieces = {piece({-0.1, 0, 0.1}, {0, 0, 0.1}),
                                        piece({0.012, 0.012, 0.1}, {0.012, 0.1, 0.1}),
                                        piece({0.02, 0, 0.1}, {0.1, 0, 0.1})};
  const std::vector<Join> joins = join_cylinders(pieces, lid(), 0.5, {});
  ASSERT_FALSE(joins.empty());
  EXPECT_EQ(joins[0].ends[0].cylinder, 0U);
  EXPECT_EQ(joins[0].ends[1].cylinder, 2U);
}

TEST(JoinCylinders, KeepsToItsThresholds) {
  const std::vector<Cylinder> pieces = {piece({-0.1, 0, 0.1}, {0, 0, 0.1}),
                                        piece({0.05, 0, 0.1}, {0.1, 0.05, 0.1})};
  JoinSettings settings;
  EXPECT_EQ(join_cylinders(pieces, lid(), 0.5, settings).size(), 1U);
  settings.distance_max = 0.049;
  EXPECT_TRUE(join_cylinders(pieces, lid(), 0.5, settings).empty());
  settings = {};
  settings.angle_max = 0.78;  // the second turns away by π/4
  EXPECT_TRUE(join_cylinders(pieces, lid(), 0.5, settings).empty());
}

RC_GTEST_PROP(JoinCylinders, MakesChainsOnly, (std::uint64_t seed)) {
  Rng rng(seed);
  const int count = uniform_integer(rng, 0, 12);
  std::vector<Cylinder> pieces;
  for (int i = 0; i < count; ++i) {
    const Vector3d a(uniform_real(rng, -0.2, 0.2), uniform_real(rng, -0.1, 0.1), uniform_real(rng, 0, 0.2));
    pieces.push_back(piece(a, a + uniform_real(rng, 0.01, 0.08) * test::random_direction(rng)));
  }
  static const RangeImage under = lid();
  const std::vector<Join> joins = join_cylinders(pieces, under, 0.5, {});
  std::set<std::pair<std::size_t, std::size_t>> ends;
  for (const Join& join : joins) {
    for (const CylinderEnd& end : join.ends) RC_ASSERT(ends.insert({end.cylinder, end.end}).second);
  }
  const std::vector<JoinedTube> tubes = joined_tubes(pieces, joins, {.radius = 0.0125});
  RC_ASSERT(tubes.size() == pieces.size() - joins.size());
  std::vector<std::size_t> cylinders;
  for (const JoinedTube& joined : tubes) {
    cylinders.insert(cylinders.end(), joined.cylinders.begin(), joined.cylinders.end());
    RC_ASSERT(total_length(joined.tube) < 0.5 * (1 + JoinSettings().length_tolerance) + 1e-9);
  }
  std::ranges::sort(cylinders);
  for (std::size_t i = 0; i < cylinders.size(); ++i) RC_ASSERT(cylinders[i] == i);
}

TEST(JoinedTubes, AreChainsThatTheTextFormatHolds) {
  // Given out of order and back to front.
  const std::vector<Cylinder> pieces = {
      piece({0.05, 0, 0.1}, {0.2, 0, 0.1}), piece({-0.05, 0, 0.1}, {-0.2, 0, 0.1}),
      piece({0.04, 0, 0.1}, {-0.04, 0, 0.1}), piece({0, 0.1, 0.1}, {0.1, 0.1, 0.1})};
  const std::vector<Join> joins = join_cylinders(pieces, lid(), 0.5, {});
  const std::vector<JoinedTube> tubes = joined_tubes(pieces, joins, {.radius = 0.0125});
  ASSERT_EQ(tubes.size(), 2U);
  EXPECT_EQ(tubes[0].cylinders.size(), 3U);
  EXPECT_EQ(tubes[0].tube.edges.size(), 5U);  // three cylinders, two joints
  EXPECT_NEAR(total_length(tubes[0].tube), 0.4, 1e-12);
  EXPECT_EQ(tubes[0].tube.nodes.front().id, 1);
  EXPECT_EQ(tubes[0].tube.nodes.back().id, 2);

  std::stringstream text;
  write_configuration(text, {tubes[0].tube, tubes[1].tube});
  const std::vector<Tube> read = read_configuration(text, "tubes");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_NEAR(total_length(read[0]), 0.4, 1e-9);
}

// Trimmed ends are where bends begin, or rounded ends.
TEST(JoinedTubes, WithFlatEndsReachToTheEndsOfTheirPoints) {
  std::vector<Cylinder> pieces = {piece({-0.1, 0, 0.1}, {0, 0, 0.1}), piece({0.01, 0, 0.1}, {0.1, 0, 0.1})};
  for (Cylinder& cylinder : pieces) cylinder.trimmed = 0.004;
  const std::vector<Join> joins = {{{{{0, 1}, {1, 0}}}, 0}};
  const Tube flat = joined_tubes(pieces, joins, {.radius = 0.0125, .flat_ends = true}).at(0).tube;
  EXPECT_TRUE(flat.flat_ends);
  EXPECT_EQ(flat.nodes.size(), 4U);
  EXPECT_NEAR(total_length(flat), 0.208, 1e-12);
  const Tube round = joined_tubes(pieces, joins, {.radius = 0.0125}).at(0).tube;
  EXPECT_FALSE(round.flat_ends);
  EXPECT_NEAR(total_length(round), 0.2, 1e-12);
}

TEST(JoinedTubes, PutOneNodeWhereTwoEndsMeet) {
  const std::vector<Cylinder> pieces = {piece({-0.1, 0, 0.1}, {0, 0, 0.1}),
                                        piece({0, 0, 0.1}, {0.1, 0, 0.1})};
  const std::vector<JoinedTube> tubes = joined_tubes(pieces, {{{{{0, 1}, {1, 0}}}, 0}}, {.radius = 0.0125});
  ASSERT_EQ(tubes.size(), 1U);
  EXPECT_EQ(tubes[0].tube.nodes.size(), 3U);
  EXPECT_EQ(tubes[0].tube.edges.size(), 2U);
}

}  // namespace
}  // namespace tanglebin
