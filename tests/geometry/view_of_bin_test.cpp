#include "tanglebin/geometry/view_of_bin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using testing::HasSubstr;

std::string complaint(const Camera& camera, const Bin& bin = {}) {
  return test::complaint([&] { validate(camera, bin); });
}

Camera camera_at(const Vector3d& position) {
  return downward_camera(192, 120, 137, position);
}

Camera tilted(Camera camera, double angle, const Vector3d& axis) {
  camera.pose.linear() = AngleAxisd(angle, axis) * camera.pose.linear();
  return camera;
}

TEST(ViewOfBin, PresetsSeeTheirBins) {
  for (const std::string_view camera : scanner_presets()) {
    for (const char* bin : {"paper", "published"})
      EXPECT_EQ(complaint(camera_preset(camera), bin_preset(bin)), "none") << camera << bin;
  }
}

TEST(ViewOfBin, ACameraUnderTheFloorIsRejected) {
  EXPECT_EQ(
      complaint(camera_at({0, 0, -2})),
      "scanner.position: found a camera at (0, 0, -2) m that looks along (0, 0, -1), expected one above "
      "the bin's floor, z > 0");
  EXPECT_NE(complaint(tilted(camera_at({0, 0, -2}), std::numbers::pi, Vector3d::UnitX())), "none");
}

TEST(ViewOfBin, ACameraThatLooksPastTheBinIsRejected) {
  EXPECT_THAT(complaint(camera_at({5, 0, 2})), HasSubstr("expected one that has the bin in its view"));
  for (const Vector3d& side : {Vector3d(5, 0, 2), Vector3d(-5, 0, 2), Vector3d(0, 5, 2), Vector3d(0, -5, 2)})
    EXPECT_NE(complaint(camera_at(side)), "none") << side.transpose();
  EXPECT_NE(complaint(tilted(camera_at({0, 0, 2}), std::numbers::pi, Vector3d::UnitX())), "none")
      << "upwards";
}

TEST(ViewOfBin, ATiltedCameraBesideTheBinAndOneInItAreFine) {
  EXPECT_EQ(complaint(tilted(camera_at({2, 0, 2}), std::numbers::pi / 4, Vector3d::UnitY())), "none");
  EXPECT_EQ(complaint(camera_at({0, 0, 0.1})), "none");
}

// Turned in any way that has any point of the bin in any pixel.
RC_GTEST_PROP(ViewOfBin, AcceptsEveryCameraThatSeesAPointOfTheBin, ()) {
  const auto number = [](int from, int to) { return *rc::gen::inRange(from, to) / 100.0; };
  Camera camera = camera_at({number(-300, 300), number(-300, 300), number(1, 300)});
  const Vector3d point(number(-27, 28), number(-18, 19), number(0, 20));
  const int column = *rc::gen::inRange(0, camera.width);
  const int row = *rc::gen::inRange(0, camera.height);
  const Vector3d to_point = point - camera.pose.translation();
  RC_PRE(to_point.norm() > 1e-3);
  const Vector3d in_camera((column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1);
  camera.pose.linear() = AngleAxisd(number(0, 628), to_point.normalized()).toRotationMatrix() *
                         Eigen::Quaterniond::FromTwoVectors(in_camera, to_point).toRotationMatrix();
  RC_ASSERT((*project(camera, point) - Eigen::Vector2d(column, row)).norm() < 1e-6);
  RC_ASSERT(complaint(camera) == "none");
}

}  // namespace
}  // namespace tanglebin
