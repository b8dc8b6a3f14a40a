#include "tanglebin/model/axis/links/length.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tanglebin/model/axis/axis_method.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using testing::AllOf;
using testing::Each;
using testing::SizeIs;

constexpr double infinite = std::numeric_limits<double>::infinity();

// What the method found of these tubes when it was told that they are as long as this, m.
AxisModel modelled_with(const std::vector<Tube>& tubes, double length_min, double length_max) {
  KnownScene known = test::paper_scene();
  known.kinds[0].segments[0].length = length_max;
  known.kinds[0].length_min = length_min;
  return model_by_axes(test::scanned(tubes), known, 1, 0);
}

// Two in line, with their ends under a third; and one alone.
std::vector<Tube> two_in_line() {
  return {test::chain(1, 0.0125, {{-0.255, 0, 0.0125}, {-0.015, 0, 0.0125}}),
          test::chain(2, 0.0125, {{0.015, 0, 0.0125}, {0.255, 0, 0.0125}}),
          test::chain(3, 0.0125, {{0, -0.12, 0.0375}, {0, 0.12, 0.0375}}),
          test::chain(4, 0.0125, {{-0.2, -0.12, 0.0125}, {-0.08, -0.1, 0.0125}, {0.0365, -0.12, 0.0125}})};
}

TEST(WithLength, IsThatOfTheTubesSeenFromEndToEnd) {
  const AxisModel found = modelled_with(two_in_line(), 0, infinite);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.24, 0.005);
  EXPECT_EQ(found.model.tubes.size(), 4U);
}

TEST(WithLength, CountsAsKnownIfThreeTubesAgree) {
  std::vector<Tube> tubes = two_in_line();
  const auto has_fit = [](LengthFit fit) { return testing::Field(&TubeEvidence::length_fit, fit); };
  EXPECT_THAT(modelled_with(tubes, 0, infinite).model.evidence,
              AllOf(SizeIs(4), Each(has_fit(LengthFit::complete))));
  tubes.resize(2);
  EXPECT_THAT(modelled_with(tubes, 0, infinite).model.evidence,
              AllOf(SizeIs(1), Each(has_fit(LengthFit::unknown))));
}

TEST(WithLength, IsSaidOfEachKindWhoseLengthWasFound) {
  const std::vector<EstimatedLength> found =
      modelled_with(two_in_line(), 0, infinite).model.estimated_lengths;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, 0U);
  EXPECT_NEAR(found[0].length, 0.24, 0.005);
  EXPECT_TRUE(modelled_with(two_in_line(), 0.24, 0.24).model.estimated_lengths.empty());
  std::vector<Tube> too_few = two_in_line();
  too_few.resize(2);
  EXPECT_TRUE(modelled_with(too_few, 0, infinite).model.estimated_lengths.empty());
}

TEST(WithLength, IsTheLargestOfARange) {
  EXPECT_EQ(modelled_with(two_in_line(), 0.1, 0.3).kinds[0].kind.length(), 0.3);
}

TEST(WithLength, IsTheOneGivenIfItIsGiven) {
  EXPECT_EQ(modelled_with(two_in_line(), 0, 0.3).kinds[0].kind.length(), 0.3);
  EXPECT_EQ(modelled_with(two_in_line(), 0.295, 0.3).kinds[0].kind.length(), 0.3);
}

// The sides of a rim are long, round, and seen from end to end.
TEST(WithLength, IsTheOneGivenWhateverLiesOnTheRim) {
  std::vector<Tube> tubes = two_in_line();
  int id = 5;
  for (const double y : {-0.225, -0.195, 0.195})
    tubes.push_back(test::chain(id++, 0.0125, {{-0.25, y, 0.2125}, {0.25, y, 0.2125}}));
  EXPECT_EQ(modelled_with(tubes, 0.24, 0.24).kinds[0].kind.length(), 0.24);
}

TEST(WithLength, IsNotTheOneGivenIfThreeTubesAreLonger) {
  EXPECT_NEAR(modelled_with(two_in_line(), 0, 0.22).kinds[0].kind.length(), 0.24, 0.005);
  const std::vector<Tube> longer = {test::chain(1, 0.0125, {{-0.2, -0.1, 0.0125}, {0.04, -0.1, 0.0125}}),
                                    test::chain(2, 0.0125, {{-0.2, 0, 0.0125}, {0.04, 0, 0.0125}}),
                                    test::chain(3, 0.0125, {{-0.2, 0.1, 0.0125}, {0.04, 0.1, 0.0125}})};
  EXPECT_NEAR(modelled_with(longer, 0, 0.22).kinds[0].kind.length(), 0.24, 0.005);
  EXPECT_EQ(modelled_with({longer[0], longer[1]}, 0, 0.22).kinds[0].kind.length(), 0.22);
}

// Something longer makes the length doubtful, but it says nothing for a shorter one.
TEST(WithLength, IsTheOneGivenIfTubesAreShorter) {
  std::vector<Tube> tubes = two_in_line();
  tubes.push_back(test::chain(5, 0.0125, {{-0.2, 0.15, 0.0125}, {0.2, 0.15, 0.0125}}));
  EXPECT_EQ(modelled_with(tubes, 0.3, 0.3).kinds[0].kind.length(), 0.3);
  EXPECT_EQ(modelled_with(tubes, 0, 0.3).kinds[0].kind.length(), 0.3);
}

// Three pairs in line, which look like one tube each, with their ends under another; six that lie alone; and
// something longer, such as the rim of a bin.
TEST(WithLength, IsTheOneGivenIfOnlySomethingElseIsLonger) {
  std::vector<Tube> tubes;
  const auto add = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    tubes.push_back(test::chain(static_cast<int>(tubes.size()) + 1, 0.0125, {from, to}));
  };
  for (const double y : {-0.1, 0.0, 0.1}) {
    add({-0.214, y, 0.0125}, {-0.014, y, 0.0125});
    add({0.014, y, 0.0125}, {0.214, y, 0.0125});
    add({-0.25, y - 0.05, 0.0125}, {-0.05, y - 0.05, 0.0125});
    add({0.05, y - 0.05, 0.0125}, {0.25, y - 0.05, 0.0125});
  }
  add({0, -0.11, 0.0375}, {0, 0.11, 0.0375});
  add({-0.18, 0.165, 0.0125}, {0.18, 0.165, 0.0125});
  EXPECT_EQ(modelled_with(tubes, 0.2, 0.2).kinds[0].kind.length(), 0.2);
  EXPECT_EQ(modelled_with(tubes, 0.19, 0.22).kinds[0].kind.length(), 0.22);
}

// Each is in two pieces, on either side of one that lies across.
TEST(WithLength, IsThatOfTubesLongerThanAnyPieceThatIsSeen) {
  std::vector<Tube> tubes = {test::chain(1, 0.0125, {{-0.06, -0.1, 0.0375}, {0.06, 0.1, 0.0375}})};
  for (const double y : {-0.08, -0.03, 0.03, 0.08}) {
    const auto id = static_cast<int>(tubes.size()) + 1;
    tubes.push_back(test::chain(id, 0.0125, {{-0.2, y, 0.0125}, {0.2, y, 0.0125}}));
  }
  const AxisModel found = modelled_with(tubes, 0, infinite);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.4, 0.005);
  EXPECT_EQ(found.model.tubes.size(), 5U);
}

// The length, m, that is found of tubes side by side that are as long as this, m.
double found_of(const std::vector<double>& lengths) {
  std::vector<Tube> tubes;
  for (const double length : lengths) {
    const double y = -0.15 + 0.05 * static_cast<double>(tubes.size());
    tubes.push_back(test::chain(static_cast<int>(tubes.size()) + 1, 0.0125,
                                {{-0.2, y, 0.0125}, {length - 0.2, y, 0.0125}}));
  }
  return modelled_with(tubes, 0, infinite).kinds[0].kind.length();
}

// Three are as long as each other. Four are as long as each other to within 7 %, as two that are taken for
// one may be.
TEST(WithLength, IsThatOfTubesThatAreAlike) {
  EXPECT_NEAR(found_of({0.347, 0.347, 0.372, 0.372, 0.4, 0.4, 0.4}), 0.4, 0.005);
}

// As where noise makes one look longer.
TEST(WithLength, IsNotThatOfTheLongest) {
  EXPECT_NEAR(found_of({0.4, 0.4, 0.4, 0.4, 0.4, 0.409}), 0.4, 0.002);
}

// One tube of which the scanner lost nine short pieces: its longest piece is a tenth of it.
TEST(WithLength, IsThatOfATubeTornIntoManyPieces) {
  PointCloud cloud = test::scanned({test::chain(1, 0.0125, {{-0.25, 0, 0.0125}, {0.25, 0, 0.0125}})});
  std::erase_if(cloud.points, [](const Eigen::Vector3f& point) {
    const double way = (point.x() + 0.25) / 0.05;
    return way - std::floor(way) < 0.3;
  });
  KnownScene known = test::paper_scene();
  known.kinds[0].segments[0].length = infinite;
  const AxisModel found = model_by_axes(cloud, known, 1, 0);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.49, 0.015);
  EXPECT_EQ(found.model.tubes.size(), 1U);
}

// The second is a single spot of votes, which has no length.
TEST(WithLength, IsThatOfATubeBesideASpot) {
  const AxisModel found = modelled_with({test::chain(1, 0.0125, {{-0.15, 0, 0.0125}, {0.15, 0, 0.0125}}),
                                         test::chain(2, 0.0125, {{0, 0.1, 0.0125}, {0.0001, 0.1, 0.0125}})},
                                        0, infinite);
  ASSERT_EQ(found.kinds[0].fragments.size(), 2U);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.3, 0.01);
}

TEST(WithLength, OfTubesThatDifferIsTheLargest) {
  const AxisModel found =
      modelled_with({test::chain(1, 0.0125, {{-0.2, -0.1, 0.0125}, {-0.05, -0.1, 0.0125}}),
                     test::chain(2, 0.0125, {{-0.2, 0, 0.0125}, {0.04, 0, 0.0125}}),
                     test::chain(3, 0.0125, {{-0.2, 0.1, 0.0125}, {0.15, 0.1, 0.0125}})},
                    0, infinite);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.35, 0.01);
  EXPECT_EQ(found.model.tubes.size(), 3U);
}

// The ends of two tubes lie under two others. No three are alike, so no length is sure; but to go on from one
// to another and back says little for a tube of a metre.
TEST(WithLength, OfTubesThatDifferIsNotThatOfSeveralInOne) {
  const double level = 3 * test::radius;
  const AxisModel found =
      modelled_with({test::chain(1, test::radius, {{-0.25, -0.1, test::radius}, {0.2, -0.1, test::radius}}),
                     test::chain(2, test::radius, {{-0.2, 0.1, test::radius}, {0.2, 0.1, test::radius}}),
                     test::chain(3, test::radius, {{-0.23, 0.17, level}, {-0.23, -0.17, level}}),
                     test::chain(4, test::radius, {{0.23, -0.17, level}, {0.23, 0.12, level}})},
                    0, infinite);
  EXPECT_EQ(found.model.tubes.size(), 4U);
  EXPECT_LT(found.kinds[0].kind.length(), 0.5);
}

// Its ends are against the walls, which hide nothing.
TEST(WithLength, CountsATubeBetweenTheWallsAsWhole) {
  const AxisModel found =
      modelled_with({test::chain(1, 0.0125, {{-0.262, 0, 0.0125}, {0.262, 0, 0.0125}})}, 0, infinite);
  EXPECT_NEAR(found.kinds[0].kind.length(), 0.524, 0.01);
}

TEST(WithLength, OfNothingIsUnknown) {
  EXPECT_EQ(modelled_with({}, 0, infinite).kinds[0].kind.length(), infinite);
}

}  // namespace
}  // namespace tanglebin
