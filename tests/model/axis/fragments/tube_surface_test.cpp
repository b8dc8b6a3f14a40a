#include "tanglebin/model/axis/fragments/tube_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::radius;

// What is seen of a strip of a tube, up to an angle (rad) to both sides of its top, if each normal is that of
// the middle of what lies within a reach (rad) of its point.
TubeSurface surface_of_strip(double arc, double reach) {
  constexpr int along = 40;
  constexpr int around = 40;
  Fragment fragment{.points = {}, .nodes = {}, .parents = {}, .ends = {}, .length = 0};
  std::vector<Eigen::Vector3f> points;
  AxisVotes votes;
  votes.reach = static_cast<float>(reach * radius);
  for (int i = 1; i < along; ++i) {
    for (int j = -around; j <= around; ++j) {
      const double angle = arc * j / around;
      const double middle = (std::max(-arc, angle - reach) + std::min(arc, angle + reach)) / 2;
      const auto at = [](double a) { return Eigen::Vector3d(0, std::sin(a), std::cos(a)); };
      fragment.points.push_back(points.size());
      points.push_back(
          (Eigen::Vector3d(-0.25 + 0.5 * i / along, 0, radius) + radius * at(angle)).cast<float>());
      votes.normals.push_back(at(middle).cast<float>());
    }
  }
  votes.votes = points;
  return surface_of(test::straight_tube(1, 0), {fragment}, {0}, points, votes, test::paper_scene().camera);
}

TEST(TubeSurface, IsAsRoundAsATubesOfWhichAsMuchIsSeen) {
  for (const double arc : {0.4, 0.5, 0.7, 1.0, 1.2}) {
    for (const double reach : {0.1, 0.36, 0.6, 0.85, 1.5}) {
      const TubeSurface surface = surface_of_strip(arc, reach);
      ASSERT_TRUE(surface.roundness) << arc;
      EXPECT_NEAR(*surface.roundness, surface.roundness_of_a_tube, 0.03) << arc << ", " << reach;
    }
  }
}

TEST(TubeSurface, IsRoundWhereNormalsAreThoseOfTheirPoints) {
  EXPECT_NEAR(*surface_of_strip(1, 0).roundness, 1, 0.01);
  EXPECT_EQ(surface_of_strip(1, 0).roundness_of_a_tube, 1);
}

TEST(TubeSurface, ShowsNoRoundnessWhereEachNormalIsThatOfTheWholeStrip) {
  EXPECT_NEAR(*surface_of_strip(0.4, 0.85).roundness, 0, 0.01);
  EXPECT_EQ(surface_of_strip(0.4, 0.85).roundness_of_a_tube, 0);
}

TEST(TubeSurface, DoesNotTellWhetherASliverIsRound) {
  EXPECT_FALSE(surface_of_strip(0.3, 0.36).roundness);
}

}  // namespace
}  // namespace tanglebin
