#include "tanglebin/scene/camera_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tanglebin/io/images.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::HasSubstr;

constexpr Intrinsics expected_intrinsics{
    .width = 640, .height = 480, .fx = 585.5, .fy = 586.25, .cx = 319.5, .cy = 241};

// 1 m above the origin, looking straight down.
Eigen::Isometry3d above() {
  return downward_camera(640, 480, 585, {0.1, 0.2, 1}).pose;
}

SceneCamera camera_of(const std::string& text, std::optional<int> image = {}) {
  return read_camera_text(text, "camera", image);
}

TEST(CameraFile, ReadsWhatScanWritesBesideADepthImage) {
  const SceneCamera camera = camera_of(camera_json(camera_with(expected_intrinsics, above())));
  EXPECT_EQ(camera.intrinsics, expected_intrinsics);
  ASSERT_TRUE(camera.pose);
  EXPECT_EQ(camera.pose->matrix(), above().matrix());
  EXPECT_EQ(camera.depth_scale, depth_scale);
  EXPECT_FALSE(camera.frame);
  EXPECT_FALSE(camera.unit);
}

// As Open3D 0.17 writes it.
constexpr const char* open3d_intrinsic =
    R"({"height": 480, "intrinsic_matrix": [585.5, 0.0, 0.0, 0.0, 586.25, 0.0, 319.5, 241.0, 1.0], "width": 640})";

TEST(CameraFile, ReadsOpen3DsPinholeCameraIntrinsic) {
  const SceneCamera camera = camera_of(open3d_intrinsic);
  EXPECT_EQ(camera.intrinsics, expected_intrinsics);
  EXPECT_FALSE(camera.pose);
  EXPECT_FALSE(camera.depth_scale);
}

TEST(CameraFile, ReadsOpen3DsPinholeCameraParametersWhoseExtrinsicLeadsFromTheWorldToTheCamera) {
  const SceneCamera camera = camera_of(
      std::string(R"({"class_name": "PinholeCameraParameters", "version_major": 1, "version_minor": 0,)") +
      R"("extrinsic": [1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, -0.1, 0.2, 1, 1], "intrinsic": )" +
      open3d_intrinsic + "}");
  EXPECT_EQ(camera.intrinsics, expected_intrinsics);
  ASSERT_TRUE(camera.pose);
  EXPECT_TRUE(camera.pose->isApprox(above())) << camera.pose->matrix();
}

// As camera_calibration_parsers writes it.
std::string calibration_file(
    const std::string& distortion,
    const std::string& projection = "585.5, 0., 319.5, 0., 0., 586.25, 241., 0., 0., 0., 1., 0.") {
  return R"(image_width: 640
image_height: 480
camera_name: rgb
camera_matrix:
  rows: 3
  cols: 3
  data: [500., 0., 300., 0., 500., 200., 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [)" +
         distortion + R"(]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [)" +
         projection + "]\n";
}

TEST(CameraFile, ReadsACalibrationFileOfRosAndTakesTheRectifiedImages) {
  const SceneCamera camera = camera_of(calibration_file("0.0, 0.0, 0.0, 0.0, 0.0"));
  EXPECT_EQ(camera.intrinsics, expected_intrinsics);
  EXPECT_FALSE(camera.pose);
}

TEST(CameraFile, TakesTheRectifiedImagesProjectionWhereTheImageBeforeIsDistorted) {
  EXPECT_EQ(camera_of(calibration_file("-0.25, 0.1, 0.0, 0.0, 0.0")).intrinsics, expected_intrinsics);
}

// As `ros2 topic echo` prints it.
std::string camera_info(const std::string& binning = "0") {
  return R"(header:
  stamp:
    sec: 1650375212
    nanosec: 35
  frame_id: camera_depth_optical_frame
height: 480
width: 640
distortion_model: plumb_bob
d:
- 0.0
- 0.0
- 0.0
- 0.0
- 0.0
k:
- 585.5
- 0.0
- 319.5
- 0.0
- 586.25
- 241.0
- 0.0
- 0.0
- 1.0
binning_x: )" +
         binning + R"(
binning_y: 0
roi:
  x_offset: 0
  y_offset: 0
  height: 0
  width: 0
  do_rectify: false
---
header:
  frame_id: the next message
)";
}

TEST(CameraFile, ReadsAPrintedCameraInfo) {
  EXPECT_EQ(camera_of(camera_info()).intrinsics, expected_intrinsics);
}

TEST(CameraFile, ReadsACameraInfoOfRos1) {
  EXPECT_EQ(
      camera_of("height: 480\nwidth: 640\nD: []\nK: [585.5, 0.0, 319.5, 0.0, 586.25, 241.0, 0.0, 0.0, 1.0]\n")
          .intrinsics,
      expected_intrinsics);
}

TEST(CameraFile, ReadsBopsCameraWhoseScaleIsInMillimetres) {
  const SceneCamera camera = camera_of(
      R"({"cx": 319.5, "cy": 241, "depth_scale": 0.1, "fx": 585.5, "fy": 586.25, "height": 480, "width": 640})");
  EXPECT_EQ(camera.intrinsics, expected_intrinsics);
  ASSERT_TRUE(camera.depth_scale);
  EXPECT_DOUBLE_EQ(*camera.depth_scale, 10000);
}

const std::string bop_scene =
    R"({"0": {"cam_K": [585.5, 0.0, 319.5, 0.0, 586.25, 241.0, 0.0, 0.0, 1.0], "depth_scale": 1.0},
  "3": {"cam_K": [585.5, 0.0, 300.0, 0.0, 586.25, 200.0, 0.0, 0.0, 1.0], "depth_scale": 0.1,
        "cam_R_w2c": [1, 0, 0, 0, -1, 0, 0, 0, -1], "cam_t_w2c": [-100.0, 200.0, 1000.0]}})";

TEST(CameraFile, ReadsOneImageOfBopsSceneCameraWhichHasNoSize) {
  const SceneCamera first = camera_of(bop_scene, 0);
  EXPECT_EQ(first.intrinsics, (Intrinsics{0, 0, 585.5, 586.25, 319.5, 241}));
  EXPECT_FALSE(first.pose);
  EXPECT_EQ(first.depth_scale, 1000);
  const SceneCamera third = camera_of(bop_scene, 3);
  EXPECT_EQ(third.intrinsics->cx, 300);
  ASSERT_TRUE(third.pose);
  EXPECT_TRUE(third.pose->isApprox(above())) << third.pose->matrix();
  EXPECT_DOUBLE_EQ(*third.depth_scale, 10000);
}

TEST(CameraFile, AsksWhichImageIsMeantOnlyIfThereAreSeveral) {
  EXPECT_THAT(complaint([] { camera_of(bop_scene); }),
              HasSubstr("camera: image: found the cameras of 2 images"));
  EXPECT_THAT(complaint([] { camera_of(bop_scene, 1); }),
              HasSubstr("image: found 1, expected one of 2 images, 0 to 3"));
  EXPECT_NO_THROW(camera_of(R"({"7": {"cam_K": [585.5, 0.0, 319.5, 0.0, 586.25, 241.0, 0.0, 0.0, 1.0]}})"));
}

TEST(CameraFile, ARotationOfFewDigitsIsMadeExact) {
  const SceneCamera camera = camera_of(
      R"({"width": 640, "height": 480, "intrinsic_matrix": [585.5, 0, 0, 0, 585.5, 0, 319.5, 241, 1],
  "camera_to_world": [[0.866, 0.5, 0, 0.1], [0.5, -0.866, 0, 0], [0, 0, -1, 1], [0, 0, 0, 1]]})");
  ASSERT_TRUE(camera.pose);
  EXPECT_TRUE(camera.pose->linear().isUnitary(1e-12));
  EXPECT_NEAR(camera.pose->linear()(0, 0), 0.866, 1e-4);
}

TEST(CameraFile, SaysWhatIsWrong) {
  const std::string matrix = R"("intrinsic_matrix": [585.5, 0, 0, 0, 585.5, 0, 319.5, 241, 1])";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "camera: found an empty file"},
      {"{}", "camera: found JSON of another kind"},
      {"{", "expected a JSON object"},
      {R"({"width": 640, )" + matrix + "}", "camera: height: is missing"},
      {R"({"width": 640, "height": 0, )" + matrix + "}", "height: found 0, expected 1 to"},
      {R"({"width": 640, "height": 480, "intrinsic_matrix": [1, 2]})",
       "intrinsic_matrix: found 2 numbers, expected 9 numbers"},
      {R"({"width": 640, "height": 480, "intrinsic_matrix": [585.5, 0, 319.5, 0, 585.5, 241, 0, 0, 1]})",
       "intrinsic_matrix: found a matrix with other entries"},
      {R"({"width": 640, "height": 480, "intrinsic_matrix": [-5, 0, 0, 0, 585.5, 0, 319.5, 241, 1]})",
       "camera.fx: found -5"},
      {R"({"width": 640, "height": 480, "camera_to_world": [[1, 2]], )" + matrix + "}",
       "camera_to_world: found '[[1,2]]', expected 4 rows of 4 numbers"},
      {R"({"width": 640, "height": 480, "camera_to_world": [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], )" +
           matrix + "}",
       "camera_to_world: found a matrix that is no rigid motion"},
      {calibration_file("-0.25, 0.1, 0.0, 0.0, 0.0", "0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0"),
       "camera:10: distortion_coefficients: found [-0.25, 0.1, 0, 0, 0], expected zeros"},
      {camera_info("2"), "binning_x: found a binned image"},
      {"width: 640\nheight: 480\n", "found 0 numbers, expected 9 numbers"},
      {"width: x\nheight: 480\nk: [585.5, 0, 319.5, 0, 586.25, 241, 0, 0, 1]", "camera:1: width: found 'x'"},
      {"width: 640\nheight: 480\nk: [a, 0, 319.5, 0, 586.25, 241, 0, 0, 1]",
       "camera:3: k: found 'a', expected a finite number"},
      {"- 1\n- 2\n", "camera:1: found a list, expected an object: names with values"},
      {"[1, 2]", "camera:1: found a list, expected an object"},
      {"3", "camera:1: found a single value, expected an object"},
      {"a: [1, 2", "camera:1: neither JSON nor YAML"},
      {"ply\nformat ascii 1.0\n", "camera:"},
      {std::string(1 << 17, ' ') + "a: 1", "bytes, expected a camera file"},
  };
  const auto complaint_of = [](const std::string& text) { return complaint([&] { camera_of(text); }); };
  for (const auto& [text, message] : faults)
    EXPECT_THAT(complaint_of(text), HasSubstr(message)) << text.substr(0, 200);
}

TEST(CameraFile, NestingWithoutEndIsRefused) {
  EXPECT_THAT(complaint([] { camera_of(std::string(60000, '[')); }), HasSubstr("camera:"));
  EXPECT_THAT(complaint([] { camera_of("k: " + std::string(60000, '{')); }), HasSubstr("camera:"));
}

}  // namespace
}  // namespace tanglebin
