#include "tanglebin/model/length_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::chain;
using test::radius;
using testing::HasSubstr;
using testing::Not;

/// Where a tube lies along x, m.
struct AlongX {
  double from;
  double to;
  double y;
};

KnownScene scene_with(double length_min, double length_max) {
  KnownScene scene;
  scene.camera = test::camera_at({0, 0, 2}, {0, 0, 0}, 800, 600, 0.9);
  scene.kinds[0].radius = radius;
  scene.kinds[0].segments = {{1, 2, length_max}};
  scene.kinds[0].length_min = length_min;
  return scene;
}

LengthFit fit_within(double length, double min, double max) {
  if (length > max) return LengthFit::too_long;
  if (min == 0) return LengthFit::unknown;
  return length < min ? LengthFit::too_short : LengthFit::complete;
}

Model lying(const std::vector<AlongX>& pieces, double min, double max) {
  Model model;
  for (const auto& [from, to, y] : pieces) {
    const int id = static_cast<int>(model.tubes.size()) + 1;
    model.tubes.push_back(chain(id, radius, {{from, y, radius}, {to, y, radius}}));
    model.evidence.push_back(
        {.joins = {}, .length = to - from, .length_fit = fit_within(to - from, min, max)});
  }
  return model;
}

std::string doubts_of_lying(const std::vector<AlongX>& pieces, double min, double max) {
  std::string text;
  for (const Finding& finding : doubts_of_lengths(scene_with(min, max), lying(pieces, min, max)))
    text += finding.code + ": " + finding.message + "\n";
  return text;
}

// Tubes of 0.34 m that were told to be 0.2 m long: each is cut in two.
std::vector<AlongX> cut_in_two(std::size_t tubes) {
  std::vector<AlongX> pieces;
  for (std::size_t i = 0; i < tubes; ++i) {
    const double y = 0.08 * static_cast<double>(i) - 0.1;
    pieces.push_back({-0.17, -0.02, y});
    pieces.push_back({0.01, 0.17, y});
  }
  return pieces;
}

TEST(LengthCheck, SaysNothingOfTubesThatAreAsLongAsTheyAreKnownToBe) {
  EXPECT_EQ(doubts_of_lying({{-0.1, 0.1, 0}, {-0.1, 0.1, 0.1}, {-0.05, 0.15, -0.1}}, 0.2, 0.2), "");
}

// "Shorter than known" alone would make the user tell a length that is even smaller.
TEST(LengthCheck, AsksForALargerLengthWhereTubesWereCutInTwo) {
  const std::string text = doubts_of_lying(cut_in_two(3), 0.2, 0.2);
  EXPECT_EQ(
      text,
      "length: 6 of 6 tubes are shorter than known: 0.15 to 0.16 m long, and 0.2 m is known; 3 times, two "
      "lie end to end in line and are together longer than that, as one that was cut in two: is the "
      "length too small? If the tubes differ in length, give its range: length = { min, max } in "
      "[[tube]]\n");
}

TEST(LengthCheck, SeesTheCutsAlsoWhereOnlyTheLargestLengthIsKnown) {
  EXPECT_THAT(doubts_of_lying(cut_in_two(3), 0, 0.2),
              HasSubstr("length: of 6 tubes, some look cut in two: 0.15 to 0.16 m long, and at most 0.2 m is "
                        "known; 3 times, two"));
}

// Two tubes of a heap may happen to lie end to end.
TEST(LengthCheck, TakesNoTwoTubesThatLieEndToEndByChanceForOne) {
  EXPECT_EQ(doubts_of_lying({{-0.21, -0.01, 0}, {0.02, 0.22, 0}, {-0.1, 0.1, 0.1}}, 0.2, 0.2), "");
}

TEST(LengthCheck, TakesShortPiecesThatMakeOneTubeOfTheKnownLengthForNoCut) {
  const std::string text = doubts_of_lying(cut_in_two(3), 0.34, 0.34);
  EXPECT_THAT(text,
              HasSubstr("6 of 6 tubes are shorter than known: 0.15 to 0.16 m long, and 0.34 m is known: is "
                        "the length right?\n"));
}

TEST(LengthCheck, TakesTubesBesideEachOtherForNoCut) {
  std::vector<AlongX> beside = cut_in_two(3);
  for (std::size_t i = 1; i < beside.size(); i += 2) beside[i].y += 2 * radius;
  const std::string text = doubts_of_lying(beside, 0.2, 0.2);
  EXPECT_THAT(text, HasSubstr("shorter than known"));
  EXPECT_THAT(text, Not(HasSubstr("cut in two")));
}

TEST(LengthCheck, AsksForARangeWhereSomeTubesAreShorterAndSomeLonger) {
  EXPECT_EQ(
      doubts_of_lying({{-0.15, 0.15, 0}, {-0.14, 0.15, 0.1}, {-0.05, 0.05, -0.1}, {-0.05, 0.06, 0.2}}, 0.18,
                      0.22),
      "length: 2 of 4 tubes are longer than known and 2 shorter: 0.1 to 0.3 m long, and 0.18 to 0.22 m is "
      "known: is the length right? If the tubes differ in length, give its range: length = { min, max } "
      "in [[tube]]\n");
}

TEST(LengthCheck, SaysThatALengthWasEstimatedAndAsksForIt) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  Model model = lying({{-0.045, 0.045, 0}, {-0.045, 0.045, 0.1}, {-0.045, 0.045, -0.1}}, 0.08, 0.083);
  model.estimated_lengths = {{.kind = 0, .length = 0.083}};
  const std::vector<Finding> doubts = doubts_of_lengths(scene_with(0, unknown), model);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(
      doubts[0].message,
      "3 of 3 tubes are longer than estimated: 0.09 to 0.09 m long, and the length was estimated as 0.083 "
      "m, because none was told: tell it, or its range: --length, or length in [[tube]]");
}

}  // namespace
}  // namespace tanglebin
