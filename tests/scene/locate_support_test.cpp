#include "tanglebin/scene/locate_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/model/scene/scanned.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

/// A bin with a tube, aslant, and what is known of it.
struct Cell {
  PointCloud cloud;
  Scene scene;
};

Cell cell_with_wall(double wall) {
  const Camera camera = test::camera_at({0.3, 0.2, 1.6}, {0, 0, 0}, 800, 600, 0.7);
  Bin bin = bin_preset("paper");
  bin.wall = wall;
  const std::vector<Tube> tubes = {test::straight_tube(1, 0.05)};
  Cell cell{cloud_from_scan(scan(tubes, bin, camera), CloudOf::tubes_and_bin, 1), {}};
  cell.scene.camera = {
      .intrinsics = intrinsics_of(camera), .pose = camera.pose, .frame = CloudFrame::world, .unit = 1};
  cell.scene.support = Support{.shape = Support::Shape::bin, .bin = bin_preset("paper")};
  return cell;
}

TEST(LocateSupport, MeasuresAWallThatIsNotGiven) {
  for (const double wall : {0.002, 0.005, 0.01, 0.02, 0.04}) {
    Cell cell = cell_with_wall(wall);
    cell.scene.wall_is_given = false;
    const LocatedScene found = locate_support(cell.scene, cell.cloud);
    EXPECT_NEAR(found.scene.support->bin.wall, wall, 0.0015);
    EXPECT_LT(found.scene.support->pose.translation().norm(), 0.001) << wall;
    EXPECT_TRUE(found.scene.wall_is_given);
  }
}

TEST(LocateSupport, LeavesAWallAsItIsGiven) {
  const Cell cell = cell_with_wall(0.019);
  EXPECT_EQ(locate_support(cell.scene, cell.cloud).scene.support->bin.wall, 0.02);
}

TEST(LocateSupport, SaysWhyTheLikelierWallDoesNotFit) {
  Cell cell = cell_with_wall(0.02);
  cell.scene.support->bin.height = 0.31;
  const std::string refusal = test::complaint([&] { locate_support(cell.scene, cell.cloud); });
  cell.scene.wall_is_given = false;
  EXPECT_EQ(test::complaint([&] { locate_support(cell.scene, cell.cloud); }), refusal);
}

TEST(LocateSupport, SaysThatTheUnitCannotBeRight) {
  Cell cell = cell_with_wall(0.02);
  cell.scene.camera.pose->translation() *= 1000;
  for (Eigen::Vector3f& point : cell.cloud.points) point *= 1000;
  EXPECT_THAT(test::complaint([&] { locate_support(cell.scene, cell.cloud); }),
              testing::HasSubstr("are unit and depth_scale those of the cloud?"));
}

TEST(LocateSupport, NeedsASupport) {
  Cell cell = cell_with_wall(0.02);
  cell.scene.support.reset();
  EXPECT_THAT(test::complaint([&] { locate_support(cell.scene, cell.cloud); }),
              testing::HasSubstr("[support]"));
}

}  // namespace
}  // namespace tanglebin
