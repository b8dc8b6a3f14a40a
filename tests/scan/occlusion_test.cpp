#include "tanglebin/scan/occlusion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tanglebin/scan/scanner.hpp"

namespace tanglebin {
namespace {

using testing::IsEmpty;

Camera camera_above() {
  return downward_camera(240, 150, focal_length_from_hfov(240, 0.4), {0, 0, 2});
}

Tube straight_tube(int id, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Tube tube;
  tube.id = id;
  tube.radius = 0.0125;
  tube.nodes = {{1, from}, {2, to}};
  tube.edges = {{0, 1, 1}};
  return tube;
}

// Tube 1 along x on the floor, tube 2 across it.
std::vector<Tube> cross(double height_of_second) {
  return {straight_tube(1, {-0.2, 0, 0.0125}, {0.2, 0, 0.0125}),
          straight_tube(2, {0, -0.15, height_of_second}, {0, 0.15, height_of_second})};
}

Occlusions occlusions_of(const std::vector<Tube>& tubes, const Camera& camera) {
  return occlusions(tubes, whole_views(tubes, camera), Bin{}, camera);
}

TEST(Occlusion, TheUpperOfTwoCrossedTubesHidesAPieceOfTheLower) {
  const Camera camera = camera_above();
  const Occlusions seen = occlusions_of(cross(0.0375), camera);
  ASSERT_EQ(seen.crossings.size(), 1U);
  const Crossing& crossing = seen.crossings.front();
  EXPECT_EQ(crossing.over, 2);
  EXPECT_EQ(crossing.under, 1);
  EXPECT_EQ(crossing.visible, crossing.pixels);
  EXPECT_NEAR(crossing.pixel.x(), camera.cx, 0.5);
  EXPECT_NEAR(crossing.pixel.y(), camera.cy, 0.5);
  EXPECT_NEAR(crossing.point.x(), 0, 0.001);
  EXPECT_NEAR(crossing.point.y(), 0, 0.001);
  EXPECT_LT(crossing.point.z(), 0.05);
  EXPECT_GT(crossing.point.z(), 0.0375);
  EXPECT_EQ(seen.tubes[0].whole - seen.tubes[0].visible, crossing.pixels);
  EXPECT_EQ(seen.tubes[1].share(), 1);
  EXPECT_LT(seen.tubes[0].share(), 1);
}

TEST(Occlusion, UnderneathTheOtherWayRound) {
  std::vector<Tube> tubes = cross(0.0375);
  std::swap(tubes[0].nodes, tubes[1].nodes);
  const Occlusions seen = occlusions_of(tubes, camera_above());
  ASSERT_EQ(seen.crossings.size(), 1U);
  EXPECT_EQ(seen.crossings.front().over, 1);
  EXPECT_EQ(seen.crossings.front().under, 2);
}

TEST(Occlusion, TubesThatAreWovenCrossTwiceWithEachOnTopOnce) {
  const Tube rising = straight_tube(1, {-0.2, 0, 0.02}, {0.2, 0, 0.08});
  Tube falling = straight_tube(2, {-0.1, -0.15, 0.1}, {-0.1, 0.1, 0.1});
  falling.nodes.push_back({3, {0.1, 0.1, 0.0125}});
  falling.nodes.push_back({4, {0.1, -0.15, 0.0125}});
  falling.edges.push_back({1, 2, 2});
  falling.edges.push_back({2, 3, 3});
  const Occlusions seen = occlusions_of({rising, falling}, camera_above());
  ASSERT_EQ(seen.crossings.size(), 2U);
  EXPECT_EQ(seen.crossings[0].over, 1);
  EXPECT_GT(seen.crossings[0].point.x(), 0);
  EXPECT_EQ(seen.crossings[1].over, 2);
  EXPECT_LT(seen.crossings[1].point.x(), 0);
}

TEST(Occlusion, ATubeUnderTwoOthersIsUnderBothButOnlyTheTopOneIsSeenThere) {
  std::vector<Tube> tubes = cross(0.0375);
  tubes.push_back(straight_tube(3, {0, -0.15, 0.0625}, {0, 0.15, 0.0625}));
  const Occlusions seen = occlusions_of(tubes, camera_above());
  ASSERT_EQ(seen.crossings.size(), 3U);
  const auto of = [&](int over, int under) {
    return *std::ranges::find_if(seen.crossings, [&](const Crossing& crossing) {
      return crossing.over == over && crossing.under == under;
    });
  };
  EXPECT_EQ(of(3, 1).visible, of(3, 1).pixels);
  EXPECT_LT(of(2, 1).visible, of(2, 1).pixels);
  EXPECT_LT(seen.tubes[1].share(), 0.1);
}

TEST(Occlusion, AWallHidesATubeFromACameraBesideTheBin) {
  Camera camera = camera_above();
  camera.pose = Eigen::Translation3d(0, -1.2, 0.3) * Eigen::AngleAxisd(-1.7, Eigen::Vector3d::UnitX());
  const std::vector<Tube> tubes{straight_tube(1, {-0.1, 0, 0.0125}, {0.1, 0, 0.0125})};
  const Occlusions seen = occlusions_of(tubes, camera);
  ASSERT_GT(seen.tubes[0].whole, 0U);
  EXPECT_EQ(seen.tubes[0].visible, 0U);
  ASSERT_EQ(seen.crossings.size(), 1U);
  EXPECT_EQ(seen.crossings[0].over, bin_label);
  EXPECT_EQ(seen.crossings[0].pixels, seen.tubes[0].whole);
}

TEST(Occlusion, ATubeOutsideOfTheImageHasNoShare) {
  const std::vector<Tube> tubes{straight_tube(1, {5, 0, 0.1}, {5, 0.3, 0.1})};
  const Occlusions seen = occlusions_of(tubes, camera_above());
  EXPECT_EQ(seen.tubes[0].whole, 0U);
  EXPECT_EQ(seen.tubes[0].share(), 0);
  EXPECT_THAT(seen.crossings, IsEmpty());
}

}  // namespace
}  // namespace tanglebin
