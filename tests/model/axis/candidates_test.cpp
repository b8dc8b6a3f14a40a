#include "tanglebin/model/axis/candidates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tanglebin/model/axis/axis_method.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

// Looks like a tube, and its points scatter by this many radii about the modelled line.
TubeCandidate that_scatters_by(double scatter) {
  return {.fragments = {},
          .points = 1000,
          .tube = test::straight_tube(1, 0),
          .surface = TubeSurface{.roundness = 1, .scatter = scatter * test::radius}};
}

std::vector<double> scatters_left(const std::vector<double>& scatters) {
  CandidatesByKind of_kinds(1);
  for (const double scatter : scatters) of_kinds[0].push_back(that_scatters_by(scatter));
  take_what_is_no_tube(of_kinds, {.shape = Support::Shape::nothing});
  std::vector<double> left;
  for (const TubeCandidate& candidate : of_kinds[0])
    left.push_back(candidate.surface->scatter / test::radius);
  return left;
}

TEST(Candidates, MayScatterAsTheOthersDo) {
  EXPECT_EQ(scatters_left({0.05, 0.05, 0.05, 0.08}).size(), 4U);
}

TEST(Candidates, AreNoTubeIfTheyScatterMuchMoreThanTheOthers) {
  EXPECT_EQ(scatters_left({0.02, 0.02, 0.02, 0.08}).size(), 3U);
}

// Of an exact scanner, most tubes show no scatter at all.
TEST(Candidates, MayScatterALittleHoweverSmoothTheOthersAre) {
  EXPECT_EQ(scatters_left({0, 0, 0, 0.016}).size(), 4U);
  EXPECT_EQ(scatters_left({0, 0, 0, 0.05}).size(), 3U);
}

// How many are left, on a plane, of tubes with so many points of which too little is seen to be round.
std::size_t number_left(const std::vector<std::size_t>& points) {
  CandidatesByKind of_kinds(1);
  for (const std::size_t number : points) {
    of_kinds[0].push_back(that_scatters_by(0));
    of_kinds[0].back().points = number;
    of_kinds[0].back().surface->roundness.reset();
  }
  take_what_is_no_tube(of_kinds, {.shape = Support::Shape::plane});
  return of_kinds[0].size();
}

// As the border of a tray is, or a crack between two plates.
TEST(Candidates, AreNoTubeIfTheyAreASliver) {
  EXPECT_EQ(number_left({1000, 1000, 500, 450}), 4U);
  EXPECT_EQ(number_left({1000, 1000, 500, 350}), 3U);
}

// The radii, in known ones, of the tubes that are taken out as foreign from tubes that show these.
std::vector<double> foreign_of(const std::vector<double>& seen) {
  CandidatesByKind of_kinds(1);
  for (const double radius : seen) {
    of_kinds[0].push_back(that_scatters_by(0));
    of_kinds[0].back().seen = {{.radius = radius * test::radius, .error = 0.02 * test::radius, .pieces = 20}};
  }
  const auto foreign = take_foreign(of_kinds, CandidatesByKind(1), {{.radius = test::radius}});
  std::vector<double> radii;
  for (const ForeignTube& tube : foreign[0]) radii.push_back(tube.radius / test::radius);
  EXPECT_EQ(of_kinds[0].size() + radii.size(), seen.size());
  return radii;
}

TEST(Candidates, AreForeignIfTheyShowAnotherRadius) {
  EXPECT_THAT(foreign_of({1, 0.98, 1.02, 0.7, 1.01}), ElementsAre(DoubleNear(0.7, 1e-9)));
  EXPECT_THAT(foreign_of({1, 0.98, 1.02, 1.4, 1.01, 0.5}),
              ElementsAre(DoubleNear(1.4, 1e-9), DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(foreign_of({1, 0.98, 1.02, 0.85, 1.01}), IsEmpty());
}

// As on real bars, whose heights were rounded and smoothed: each shows another radius.
TEST(Candidates, AreNotForeignWhereNoRadiusIsSeenWell) {
  EXPECT_THAT(foreign_of({1, 0.9, 1.06, 0.72, 0.84}), IsEmpty());
}

// All are seen too thin, so the radius or the scale is wrong.
TEST(Candidates, AreNotForeignWhereMostDoNotShowTheKnownRadius) {
  EXPECT_THAT(foreign_of({0.85, 0.86, 0.84, 0.76, 0.6}), IsEmpty());
}

// On a table, a tube of another radius looks like none of the known ones. Noise on a floor does, too, and
// shows a radius only badly.
TEST(Candidates, ThatAreNoneOfTheKnownTubesAreForeignIfTheyShowARadiusWell) {
  for (const double error : {0.02, 0.1}) {
    CandidatesByKind of_kinds(1);
    for (const double radius : {1.0, 0.98, 1.02, 0.5}) {
      of_kinds[0].push_back(that_scatters_by(0));
      of_kinds[0].back().seen = {
          {.radius = radius * test::radius, .error = error * radius * test::radius, .pieces = 20}};
    }
    of_kinds[0].back().surface->roundness = 2;
    CandidatesByKind odd = take_what_is_no_tube(of_kinds, {.shape = Support::Shape::plane});
    EXPECT_EQ(odd[0].size(), 1U);
    const auto foreign = take_foreign(of_kinds, std::move(odd), {{.radius = test::radius}});
    EXPECT_EQ(of_kinds[0].size(), 3U);
    EXPECT_EQ(foreign[0].size(), error < 0.05 ? 1U : 0U);
  }
}

// Whether there can be a tube on the way from one place to another, beside a bin that is known to 5 mm.
bool may_be_a_tube(const std::vector<Eigen::Vector3d>& way) {
  CandidatesByKind of_kinds(1);
  of_kinds[0].push_back(that_scatters_by(0));
  of_kinds[0].back().tube = test::chain(1, test::radius, way);
  Support support = test::paper_scene().support;
  support.margin = 0.005;
  take_what_is_no_tube(of_kinds, support);
  return !of_kinds[0].empty();
}

// A rim may be as round as a tube.
TEST(Candidates, AreNoTubeIfTheyLieAlongTheRim) {
  const Bin bin = test::paper_scene().support.bin;
  const double in_wall = bin.width / 2 + bin.wall / 2;
  const double inside = bin.width / 2 - test::radius;
  for (const double side : {-1.0, 1.0}) {
    const auto along = [&](double y, double z) {
      return std::vector<Eigen::Vector3d>{{-0.2, side * y, z}, {0, side * y, z}, {0.2, side * y, z}};
    };
    EXPECT_FALSE(may_be_a_tube(along(in_wall, bin.height - test::radius)));
    EXPECT_TRUE(may_be_a_tube(along(in_wall, bin.height + test::radius))) << "on the rim";
    EXPECT_TRUE(may_be_a_tube(along(inside, bin.height - test::radius))) << "at the wall";
    EXPECT_TRUE(may_be_a_tube(along(in_wall, bin.height / 2))) << "at a wall that is bent";
  }
  EXPECT_TRUE(may_be_a_tube({{0, 0, 0.1}, {0, in_wall, bin.height - test::radius}})) << "leans on a wall";
}

// A wall, which is flat, in a bin that is not exactly a box.
TEST(Candidates, AreNoTubeInABinWithAMarginIfTheyAreNotRound) {
  for (const double margin : {0.0, 0.005}) {
    CandidatesByKind of_kinds(1);
    of_kinds[0].push_back(that_scatters_by(0));
    of_kinds[0].push_back(that_scatters_by(0));
    of_kinds[0].front().surface->roundness = 0;
    take_what_is_no_tube(of_kinds, {.shape = Support::Shape::bin, .margin = margin});
    EXPECT_EQ(of_kinds[0].size(), margin > 0 ? 1U : 2U);
  }
}

// Of a shiny bar, a narrow strip is seen: normals that are means over their neighbours hardly turn on it. A
// piece of a floor that is not known as such looks like that, too.
TEST(Candidates, MayShowAsLittleRoundnessAsANarrowStripCan) {
  for (const auto shape : {Support::Shape::plane, Support::Shape::nothing}) {
    CandidatesByKind of_kinds(1);
    of_kinds[0].push_back(that_scatters_by(0));
    of_kinds[0].front().surface->roundness = 0.4;
    of_kinds[0].push_back(of_kinds[0].front());
    of_kinds[0].back().surface->roundness_of_a_tube = 0.5;
    take_what_is_no_tube(of_kinds, {.shape = shape});
    EXPECT_EQ(of_kinds[0].size(), shape == Support::Shape::plane ? 1U : 0U);
  }
}

// How many tubes are found of one that lies in the bin and a ball of its radius, if their length is as told,
// m.
std::size_t tubes_beside_a_ball(double length_min, double length) {
  KnownScene known = test::paper_scene();
  known.kinds[0].segments[0].length = length;
  known.kinds[0].length_min = length_min;
  const std::vector<Tube> tubes = {test::straight_tube(1, 0),
                                   test::chain(2, test::radius, {{0, 0.1, 0.0125}, {1e-4, 0.1, 0.0125}})};
  return model_by_axes(test::scanned(tubes), known, 1, 0).model.tubes.size();
}

TEST(Candidates, AreNoTubeIfTheyAreABall) {
  EXPECT_EQ(tubes_beside_a_ball(0, std::numeric_limits<double>::infinity()), 1U);
  EXPECT_EQ(tubes_beside_a_ball(0, 0.5), 1U);
  EXPECT_EQ(tubes_beside_a_ball(0.5, 0.5), 1U);
}

}  // namespace
}  // namespace tanglebin
