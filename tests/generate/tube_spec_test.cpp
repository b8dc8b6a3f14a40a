#include "tanglebin/generate/tube_spec.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Set C of the published data: two junctions, nodes 1 and 2, and four ends.
TubeSpec tree() {
  const auto segment = [](int from, int to, double length, int fewest, int most) {
    return SegmentSpec{{from, to, length}, fewest, most, 0.02, 0.0, 20 * degree};
  };
  return {.radius = 0.0125,
          .mass = 0.75,
          .segments = {segment(1, 2, 0.30, 5, 10), segment(1, 3, 0.10, 2, 5), segment(1, 4, 0.10, 2, 5),
                       segment(2, 5, 0.10, 2, 5), segment(2, 6, 0.15, 2, 6)}};
}

std::string complaint(const TubeSpec& spec) {
  return test::complaint([&] { validate(spec, "tube"); });
}

// What is said of a chain after one change of it.
template <typename Change>
std::string complaint_after(Change change) {
  TubeSpec spec;
  change(spec);
  return complaint(spec);
}

TEST(TubeSpec, AcceptsThePapersChainsAndThePublishedTrees) {
  EXPECT_EQ(complaint(TubeSpec{}), "none");
  EXPECT_EQ(complaint(TubeSpec{.mass = 0, .density = 1200}), "none");
  EXPECT_EQ(complaint(tree()), "none");
}

TEST(TubeSpec, HasEitherAMassOrADensity) {
  EXPECT_EQ(complaint(TubeSpec{.density = 1200}),
            "tube.mass: found 0.5, expected 0, because there is a density");
  EXPECT_EQ(complaint(TubeSpec{.mass = 0, .density = -1}),
            "tube.density: found -1, expected a positive number");
}

TEST(TubeSpec, AcceptsTheExtremesThatStillMakeATube) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].bend_max = std::numbers::pi; }), "none");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].cylinders_min = 10; }), "none");
  EXPECT_EQ(complaint_after([](TubeSpec& s) {
              s.segments[0].length = 1.0;
              s.segments[0].cylinders_max = 4;
              s.segments[0].cylinders_min = 4;
              s.segments[0].cylinder_length_min = 0.25;
            }),
            "none");
}

TEST(TubeSpec, ForgivesTheRoundingOfThreeTenths) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0] = {{.length = 0.3}, 3, 3, 0.1}; }), "none");
}

TEST(TubeSpec, NamesASizeThatIsNotPositive) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.radius = 0; }),
            "tube.radius: found 0, expected a positive number");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.mass = -0.5; }),
            "tube.mass: found -0.5, expected a positive number");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.mass = std::numeric_limits<double>::quiet_NaN(); }),
            "tube.mass: found nan, expected a positive number");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.mass = 1e12; }),
            "tube.mass: found 1000000000000 kg, expected 1e-09 to 1000000000 kg");
  EXPECT_EQ(
      complaint_after([](TubeSpec& s) { s.segments[0].length = std::numeric_limits<double>::infinity(); }),
      "tube.length: found inf, expected a positive number");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].cylinder_length_min = 0; }),
            "tube.cylinder_length_min: found 0, expected a positive number");
}

TEST(TubeSpec, NamesNumbersOfCylindersThatCannotBeDrawn) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].cylinders_min = 0; }),
            "tube.cylinders_min: found 0, expected at least 1");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].cylinders_max = 4; }),
            "tube.cylinders_max: found 4, expected from cylinders_min, 5, to 1000");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].cylinders_max = 1'000'000'000; }),
            "tube.cylinders_max: found 1000000000, expected from cylinders_min, 5, to 1000");
}

TEST(TubeSpec, SaysWhenTheShortestCylindersAreLongerThanTheTube) {
  EXPECT_EQ(
      complaint_after([](TubeSpec& s) { s.segments[0].cylinder_length_min = 0.0625; }),
      "tube.cylinders_max: found 10 cylinders of at least 0.0625 m, which make 0.625 m, expected no more "
      "than the length, 0.5 m");
}

TEST(TubeSpec, NamesAnglesThatAreNone) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].bend_max = 181 * degree; }),
            "tube.bend_max_deg: found 181°, expected an angle from 0 to 180°");
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments[0].bend_min = -1 * degree; }),
            "tube.bend_min_deg: found -1°, expected an angle from 0 to 180°");
  EXPECT_EQ(complaint_after([](TubeSpec& s) {
              s.segments[0].bend_min = 45 * degree;
              s.segments[0].bend_max = 30 * degree;
            }),
            "tube.bend_min_deg: found 45°, expected at most bend_max_deg, 30°");
  EXPECT_EQ(
      complaint_after([](TubeSpec& s) { s.segments[0].bend_max = std::numeric_limits<double>::quiet_NaN(); }),
      "tube.bend_max_deg: found nan°, expected an angle from 0 to 180°");
}

TEST(TubeSpec, NamesTheSegmentOfATreeThatIsWrong) {
  TubeSpec spec = tree();
  spec.segments[2].length = -1;
  EXPECT_EQ(complaint(spec), "tube.segment[2].length: found -1, expected a positive number");
}

TEST(TubeSpec, NamesASegmentThatStartsNowhere) {
  TubeSpec spec = tree();
  spec.segments[1].from = 5;  // which only the fourth segment reaches
  EXPECT_EQ(complaint(spec),
            "tube.segment[1].from: found node 5, expected node 1 or the end of an earlier segment");
  spec = tree();
  spec.segments[0].from = 2;
  EXPECT_EQ(complaint(spec),
            "tube.segment[0].from: found node 2, expected node 1, where the first segment starts");
}

TEST(TubeSpec, NamesASegmentThatClosesALoop) {
  TubeSpec spec = tree();
  spec.segments[4].to = 3;
  EXPECT_EQ(complaint(spec),
            "tube.segment[4].to: found node 3, which closes a loop, expected a node that no earlier segment "
            "reaches");
  spec = tree();
  spec.segments[0].to = 1;
  EXPECT_EQ(complaint(spec),
            "tube.segment[0].to: found node 1, which closes a loop, expected a node that no earlier segment "
            "reaches");
}

TEST(TubeSpec, NamesANodeThatLeavesAGap) {
  TubeSpec spec = tree();
  spec.segments[4].to = 7;
  EXPECT_EQ(complaint(spec),
            "tube.segment[4].to: found node 7, expected a node from 2 to 6, one more than the segments");
}

TEST(TubeSpec, NeedsASegment) {
  EXPECT_EQ(complaint_after([](TubeSpec& s) { s.segments.clear(); }),
            "tube.segment: found none, expected at least one segment");
}

TEST(TubeSpec, PutsThePlaceBeforeTheField) {
  try {
    validate(TubeSpec{.radius = -1}, "set[2].tube");
    FAIL() << "a negative radius passed";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().field, "set[2].tube.radius");
  }
}

}  // namespace
}  // namespace tanglebin
