#include "tanglebin/model/axis/candidates.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

// Looks like a tube, and its points scatter by this many radii about the modelled line.
TubeCandidate that_scatters_by(double scatter) {
  return {.fragments = {},
          .points = 1000,
          .tube = test::straight_tube(1, 0),
          .surface = {.roundness = 1, .scatter = scatter * test::radius}};
}

std::vector<double> scatters_left(const std::vector<double>& scatters) {
  std::vector<std::vector<TubeCandidate>> of_kinds(1);
  for (const double scatter : scatters) of_kinds[0].push_back(that_scatters_by(scatter));
  drop_what_is_no_tube(of_kinds, {.shape = Support::Shape::nothing});
  std::vector<double> left;
  for (const TubeCandidate& candidate : of_kinds[0]) left.push_back(candidate.surface.scatter / test::radius);
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

}  // namespace
}  // namespace tanglebin
