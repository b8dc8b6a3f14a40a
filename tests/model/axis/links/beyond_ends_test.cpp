#include "tanglebin/model/axis/links/beyond_ends.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tanglebin/base/constants.hpp"
#include "tests/model/axis/fragments/straight_fragment.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::radius;
using test::straight_fragment;

// How far the tube may go on beyond the end towards +x of a piece that lies along x, m.
double hidden_beyond_end(const PointCloud& seen) {
  std::vector<Fragment> fragments = {straight_fragment({-0.15, 0, radius}, {0, 0, radius})};
  look_beyond_ends(fragments, radius, RangeImage(seen.points, test::paper_scene().camera));
  return fragments.front().ends[1].hidden;
}

TEST(BeyondEnds, AnEmptyFloorHidesNothing) {
  EXPECT_EQ(hidden_beyond_end(test::scanned({})), 0);
}

TEST(BeyondEnds, WhereNothingWasMeasuredATubeMayGoOn) {
  EXPECT_GT(hidden_beyond_end({}), 38 * radius);
}

// A tube across, over the end: what it hides is about as wide as it is.
TEST(BeyondEnds, ATubeAcrossHidesWhatIsUnderIt) {
  const Tube across = test::chain(1, radius, {{0.03, -0.15, 3 * radius}, {0.03, 0.15, 3 * radius}});
  const double hidden = hidden_beyond_end(test::scanned({across}));
  EXPECT_GT(hidden, 1 * radius);
  EXPECT_LT(hidden, 5 * radius);
}

// How far a tube may go on beyond an end at the origin, in radii, where nothing was measured and there are
// walls at x > 10 and at y > 20 radii. Its direction is turned so far from the first wall's normal.
double hidden_before_walls(double turn_deg) {
  const double r = radius;
  const double turn = turn_deg * degree;
  const std::vector<Eigen::AlignedBox3d> walls = {
      {Eigen::Vector3d(10 * r, -1, 0), Eigen::Vector3d(20 * r, 1, 1)},
      {Eigen::Vector3d(-1, 20 * r, 0), Eigen::Vector3d(1, 30 * r, 1)}};
  const Eigen::Vector3d end(0, 0, 5 * r);
  std::vector<Fragment> fragments = {
      straight_fragment(end - 0.1 * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0), end)};
  look_beyond_ends(fragments, r, RangeImage({}, test::paper_scene().camera, walls));
  return fragments.front().ends[1].hidden / r;
}

TEST(BeyondEnds, AWallEndsATubeThatMeetsItHeadOn) {
  EXPECT_NEAR(hidden_before_walls(0), 8, 1.2);
  EXPECT_NEAR(hidden_before_walls(25), 8.9, 1.2);
}

// To the first wall, then along it to the second one, in the corner.
TEST(BeyondEnds, ATubeThatMeetsAWallAslantGoesOnAlongIt) {
  const double to_wall = 9.5 / std::cos(45 * degree);
  EXPECT_NEAR(hidden_before_walls(45), to_wall + 10 - 1.6, 1.5);
}

TEST(UnseenLength, IsWhatNeitherWasSeenNorMayBeHidden) {
  TubeKind kind{.radius = 0.01, .segments = {{1, 2, 0.5}}, .length_min = 0.5};
  const LinkSettings settings{.length_tolerance = 0.04, .hidden_stretch = 2};
  EXPECT_DOUBLE_EQ(unseen_length(0.3, 0.05, kind, settings), 0.48 - 0.3 - 0.1 - 0.02);
  EXPECT_LT(unseen_length(0.5, 0, kind, settings), 0);
  kind.length_min = 0;  // not known
  EXPECT_LT(unseen_length(0, 0, kind, settings), 0);
}

}  // namespace
}  // namespace tanglebin
