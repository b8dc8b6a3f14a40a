#include "tanglebin/scene/locate_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

// Raises the floor by up to `height` (m), most in its middle.
void bulge_floor(Cell& cell, double height) {
  const Bin& bin = cell.scene.support->bin;
  for (std::size_t i = 0; i < cell.cloud.points.size(); ++i) {
    Eigen::Vector3f& point = cell.cloud.points[i];
    const double x = point.x() / bin.length;
    const double y = point.y() / bin.width;
    if (std::abs(point.z()) > 1e-4 || std::abs(x) > 0.5 || std::abs(y) > 0.5) continue;
    point.z() += static_cast<float>(height * std::cos(std::numbers::pi * x) * std::cos(std::numbers::pi * y));
  }
}

TEST(LocateSupport, SaysThatAFloorBulgesAndHowLittleIsKnownThen) {
  Cell flat = cell_with_wall(0.012);
  flat.scene.wall_is_given = false;
  EXPECT_TRUE(locate_support(flat.scene, flat.cloud).doubts.empty());
  for (const double height : {0.006, 0.01}) {
    Cell cell = flat;
    bulge_floor(cell, height);
    const LocatedScene found = locate_support(cell.scene, cell.cloud);
    EXPECT_THAT(found.doubts, testing::ElementsAre(testing::HasSubstr("the floor is uneven by")));
    EXPECT_THAT(found.doubts, testing::ElementsAre(testing::HasSubstr("; give margin = 0.00")));
    EXPECT_GT(found.located.position_sd.z(), height / 6);
    EXPECT_LT(std::abs(found.scene.support->pose.translation().z()), 2.5 * found.located.position_sd.z());
    EXPECT_NEAR(found.scene.support->bin.wall, 0.012, 0.0015);
  }
}

// A table around a bin that is let into it, level with its rim.
void add_table_at_rim(Cell& cell, const Bin& bin) {
  const Camera camera = test::camera_at({0.3, 0.2, 1.6}, {0, 0, 0}, 800, 600, 0.7);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Ray ray = ray_through(camera, u, v);
      const double distance = (bin.height - ray.origin.z()) / ray.direction.z();
      const Eigen::Vector3d point = ray.origin + distance * ray.direction;
      if (std::abs(point.x()) > bin.length / 2 + bin.wall || std::abs(point.y()) > bin.width / 2 + bin.wall)
        cell.cloud.points.emplace_back(point.cast<float>());
    }
  }
}

TEST(LocateSupport, WritesNoWallThatWasNotSeen) {
  Cell cell = cell_with_wall(0.02);
  cell.scene.wall_is_given = false;
  add_table_at_rim(cell, cell.scene.support->bin);
  const LocatedScene found = locate_support(cell.scene, cell.cloud);
  EXPECT_FALSE(found.scene.wall_is_given);
  EXPECT_EQ(found.scene.support->bin.wall, 0.02);
  EXPECT_THAT(found.doubts, testing::ElementsAre(testing::HasSubstr("how thick the walls are is not seen")));
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
