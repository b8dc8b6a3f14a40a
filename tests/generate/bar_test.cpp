#include "tanglebin/generate/bar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tanglebin/generate/generate.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::HasSubstr;

Piece straight(double length) {
  return {.length = length};
}

Piece arc(double bend, double bend_radius, double twist = 0) {
  return {.bend = bend, .bend_radius = bend_radius, .twist = twist};
}

TubeSpec bar(std::vector<Piece> pieces) {
  return {.radius = 0.006, .mass = 0.1, .segments = {}, .pieces = std::move(pieces), .flat_ends = true};
}

Vector3d last_direction(const std::vector<Vector3d>& line) {
  return (line.back() - line[line.size() - 2]).normalized();
}

std::string complaint_about(const TubeSpec& spec) {
  return test::complaint([&] { validate(spec); });
}

TEST(Bar, AStraightPieceIsOneCylinder) {
  const std::vector<Vector3d> line = centre_line({straight(0.1), straight(0.2)});
  ASSERT_EQ(line.size(), 3U);
  EXPECT_TRUE(line.back().isApprox(Vector3d(0, 0, 0.3)));
}

TEST(Bar, AQuarterCircleEndsAQuarterFurther) {
  const std::vector<Vector3d> line = centre_line({straight(0.05), arc(pi / 2, 0.02), straight(0.05)});
  EXPECT_TRUE(line.front().isZero());
  EXPECT_TRUE(line.back().isApprox(Vector3d(0.07, 0, 0.07), 1e-12));
  EXPECT_TRUE(last_direction(line).isApprox(Vector3d::UnitX(), 1e-12));
}

TEST(Bar, TwoBendsToTheSameSideMakeAUAndToTheOtherAnS) {
  const auto both = [](double twist) {
    return centre_line(
        {straight(0.05), arc(pi / 2, 0.02), straight(0.05), arc(pi / 2, 0.02, twist), straight(0.05)});
  };
  EXPECT_TRUE(last_direction(both(0)).isApprox(-Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(last_direction(both(pi)).isApprox(Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(last_direction(both(pi / 2)).isApprox(Vector3d::UnitY(), 1e-12)) << "out of the plane";
  EXPECT_NEAR(both(0).back().y(), 0, 1e-15);
}

// Of an arc of any angle and radius: every chord's ends are on the circle and its middle is within the
// tolerance of it, and with one chord fewer it would not be.
RC_GTEST_PROP(Bar, ChordsAreAsFewAsTheToleranceAllows, ()) {
  const double bend = static_cast<double>(*rc::gen::inRange(1, 1800)) * pi / 1800;
  const double radius = static_cast<double>(*rc::gen::inRange(1, 1000)) / 1000;
  const std::vector<Vector3d> line = centre_line({arc(bend, radius)});
  const Vector3d centre(radius, 0, 0);
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    RC_ASSERT(std::abs((line[i] - centre).norm() - radius) < 1e-12);
    const double sagitta = radius - ((line[i - 1] + line[i]) / 2 - centre).norm();
    RC_ASSERT(sagitta <= arc_tolerance * (1 + 1e-6));
    length += (line[i] - line[i - 1]).norm();
  }
  const double chords = static_cast<double>(line.size() - 1);
  RC_ASSERT(chords == chords_of(arc(bend, radius)));
  if (chords > 1) RC_ASSERT(radius * (1 - std::cos(bend / (chords - 1) / 2)) > arc_tolerance);
  const double half_turn = bend / chords / 2;
  RC_ASSERT(std::abs(length - length_of(arc(bend, radius)) * std::sin(half_turn) / half_turn) < 1e-12);
}

TEST(Bar, IsDrawnInAnyDirectionWithTheSameShape) {
  const TubeSpec spec =
      bar({straight(0.05), arc(1.8, 0.018), straight(0.07), arc(1.7, 0.018), straight(0.05)});
  Rng rng(3);
  const Tube first = draw_tube(rng, spec, 1);
  const Tube second = draw_tube(rng, spec, 2);
  EXPECT_TRUE(first.flat_ends);
  EXPECT_EQ(first.nodes.front().id, 1);
  EXPECT_EQ(first.nodes.back().id, 2);
  EXPECT_TRUE(first.nodes.front().position.isZero());
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  for (std::size_t i = 1; i < first.nodes.size(); ++i) {
    EXPECT_NEAR(first.nodes[i].position.norm(), second.nodes[i].position.norm(), 1e-12);
  }
  EXPECT_GT((first.nodes.back().position - second.nodes.back().position).norm(), 0.001);
  EXPECT_NEAR(total_length(first), segments_of(spec).front().length, 3e-5);
}

TEST(Bar, OfADensityWeighsWhatItsVolumeDoes) {
  TubeSpec spec = bar({straight(0.2)});
  spec.mass = 0;
  spec.density = 2700;
  Rng rng(1);
  EXPECT_NEAR(draw_tube(rng, spec, 1).mass, 2700 * pi * 0.006 * 0.006 * 0.2, 1e-12);
}

TEST(Bar, OneThatMakesSenseIsValid) {
  EXPECT_EQ(complaint_about(bar({straight(0.05), arc(pi, 0.02), straight(0.05)})), "none");
  EXPECT_EQ(complaint_about(bar({straight(0.006)})), "none");
}

TEST(Bar, ABendNarrowerThanTheBarIsRefused) {
  EXPECT_EQ(complaint_about(bar({straight(0.05), arc(1, 0.005), straight(0.05)})),
            "tube.piece[1].bend_radius: found 0.005, expected at least the bar's radius, 0.006 m");
}

TEST(Bar, ABendOfMoreThanHalfATurnIsRefused) {
  EXPECT_THAT(complaint_about(bar({straight(0.05), arc(3.2, 0.02), straight(0.05)})),
              HasSubstr("tube.piece[1].bend_deg: found 183.346°, expected an angle from 0 to 180°"));
}

TEST(Bar, APieceIsEitherStraightOrAnArc) {
  EXPECT_THAT(complaint_about(bar({straight(0)})),
              HasSubstr("tube.piece[0].length: found 0, expected a positive"));
  Piece both = arc(1, 0.02);
  both.length = 0.1;
  EXPECT_THAT(complaint_about(bar({both})), HasSubstr("tube.piece[0].bend_deg: found 57.2958°, expected 0"));
}

TEST(Bar, AFlatEndNeedsAStraightPieceBeforeIt) {
  EXPECT_EQ(
      complaint_about(bar({arc(1, 0.02), straight(0.05)})),
      "tube.piece[0].length: found 0, expected at least the radius, 0.006 m, because the ends are flat");
  EXPECT_THAT(complaint_about(bar({straight(0.05), arc(1, 0.02), straight(0.001)})),
              HasSubstr("tube.piece[2].length: found 0.001"));
  TubeSpec round = bar({arc(1, 0.02)});
  round.flat_ends = false;
  EXPECT_EQ(complaint_about(round), "none");
}

TEST(Bar, OneThatPassesThroughItselfIsRefused) {
  EXPECT_THAT(
      complaint_about(bar({straight(0.1), arc(pi, 0.01), straight(0.05), arc(pi, 0.01), straight(0.1)})),
      HasSubstr("tube.piece: found a bar that passes through itself"));
}

TEST(Bar, AnArcOfTooManyCylindersIsRefused) {
  EXPECT_THAT(complaint_about(bar({straight(0.1), arc(pi, 1000), straight(0.1)})),
              HasSubstr("expected at most 1000 in a bar"));
}

TEST(Bar, HasPiecesOrSegmentsButNotBoth) {
  TubeSpec spec = bar({straight(0.1)});
  spec.segments.resize(1);
  EXPECT_EQ(complaint_about(spec), "tube.segment: found 1 segments, expected none, because there are pieces");
}

TEST(FlatEnds, OfAChainNeedCylindersOfARadius) {
  TubeSpec spec;
  spec.flat_ends = true;
  EXPECT_EQ(complaint_about(spec), "none");
  spec.segments[0].cylinder_length_min = 0.01;
  EXPECT_EQ(complaint_about(spec),
            "tube.cylinder_length_min: found 0.01, expected at least the radius, 0.0125 m, because the ends "
            "are flat");
}

}  // namespace
}  // namespace tanglebin
