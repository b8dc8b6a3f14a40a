#include "tanglebin/scene/read_measurement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/io/images.hpp"
#include "tanglebin/io/ply.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::HasSubstr;

constexpr Intrinsics small_camera{.width = 2, .height = 1, .fx = 100, .fy = 100, .cx = 0, .cy = 0};

Measurement measured(const std::string& bytes, const Scene& scene) {
  std::istringstream in(bytes);
  return read_measurement(in, "file", scene);
}

Scene with(SceneCamera camera) {
  Scene scene;
  scene.camera = camera;
  return scene;
}

// Depths of 1.5 and 2 m, in steps of 0.1 mm.
std::string png() {
  return depth_png({.width = 2, .height = 1, .depths = {1.5F, 2}});
}

// As numpy.save() writes two float32 of 1500 and 2000.
std::string npy() {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }";
  header.append(117 - header.size(), ' ');
  header += '\n';
  return "\x93NUMPY" + std::string("\x01\x00\x76\x00", 4) + header +
         std::string("\x00\x80\xbb\x44\x00\x00\xfa\x44", 8);
}

TEST(ReadMeasurement, ACloudIsAsItIs) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}};
  cloud.width = 1;
  std::ostringstream ply;
  write_ply(ply, cloud);
  const Measurement measurement = measured(ply.str(), with({.unit = 0.001}));
  EXPECT_EQ(measurement.cloud.points, cloud.points);
  EXPECT_EQ(measurement.scene.camera.unit, 0.001);
  EXPECT_FALSE(measurement.scene.camera.frame);
}

TEST(ReadMeasurement, ADepthImageIsAnOrganizedCloudInTheCamerasFrameInMetres) {
  const SceneCamera camera{
      .intrinsics = small_camera, .frame = CloudFrame::world, .unit = 1, .depth_scale = 10000};
  const Measurement measurement = measured(png(), with(camera));
  EXPECT_EQ(measurement.cloud.width, 2U);
  EXPECT_EQ(measurement.cloud.height, 1U);
  EXPECT_TRUE(measurement.cloud.points[0].isApprox(Eigen::Vector3f(0, 0, 1.5F)));
  EXPECT_TRUE(measurement.cloud.points[1].isApprox(Eigen::Vector3f(0.02F, 0, 2)));
  EXPECT_EQ(measurement.scene.camera.frame, CloudFrame::camera);
  EXPECT_EQ(measurement.scene.camera.unit, 1);
  EXPECT_EQ(measurement.cloud.depth_scale, 10000);
}

TEST(ReadMeasurement, IntegersCountByTheDepthScaleOrElseByTheUnit) {
  const Measurement millimetres = measured(png(), with({.intrinsics = small_camera, .unit = 0.001}));
  EXPECT_NEAR(millimetres.cloud.points[1].z(), 20, 1e-5);
  EXPECT_THAT(complaint([] { measured(png(), with({.intrinsics = small_camera})); }),
              HasSubstr("file: depth_scale: found nothing that says what the image's numbers are"));
}

TEST(ReadMeasurement, FloatsCountByTheUnitWhateverACameraFileSaysOfIntegers) {
  const Measurement metres = measured(npy(), with({.intrinsics = small_camera, .depth_scale = 10000}));
  EXPECT_EQ(metres.cloud.points[0].z(), 1500);
  EXPECT_FALSE(metres.cloud.depth_scale);
  const Measurement millimetres =
      measured(npy(), with({.intrinsics = small_camera, .unit = 0.001, .depth_scale = 10000}));
  EXPECT_EQ(millimetres.cloud.points[0].z(), 1.5F);
}

TEST(ReadMeasurement, TheImageHasTheSizeThatACameraFileLacks) {
  Intrinsics lens = small_camera;
  lens.width = lens.height = 0;
  const Measurement measurement = measured(png(), with({.intrinsics = lens, .depth_scale = 10000}));
  EXPECT_EQ(measurement.scene.camera.intrinsics, small_camera);
  EXPECT_THAT(complaint([] { measured(png(), Scene{}); }),
              HasSubstr("file: camera: found a depth image, and nothing of the camera that took it"));
}

}  // namespace
}  // namespace tanglebin
