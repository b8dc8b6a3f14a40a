#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/scene/read_scene.hpp"
#include "tanglebin/scene/write_scene.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::HasSubstr;

Scene read(const std::string& text) {
  std::istringstream in(text);
  return read_scene(in, "scene.toml", ".");
}

std::string write(const Scene& scene) {
  std::ostringstream out;
  write_scene(out, scene);
  return out.str();
}

TEST(SceneFile, SaysWhatIsKnown) {
  const Scene scene = read(R"(
[camera]
width = 1944
height = 1200
hfov_deg = 90
position = [0, 0, 1.2]
look_at = [0, 0, 0]
frame = "camera"
unit = "mm"
depth_scale = 1000

[support]
shape = "bin"
length = 0.6
width = 0.4
height = 0.25
margin = 0.004

[[tube]]
radius = 0.006
length = 0.244
ends = "flat"
)");
  ASSERT_TRUE(scene.camera.intrinsics);
  EXPECT_EQ(scene.camera.intrinsics->width, 1944);
  EXPECT_NEAR(scene.camera.intrinsics->fx, 972, 1e-9);
  EXPECT_EQ(scene.camera.intrinsics->cx, 971.5);
  ASSERT_TRUE(scene.camera.pose);
  EXPECT_TRUE(scene.camera.pose->isApprox(downward_camera(1944, 1200, 972, {0, 0, 1.2}).pose));
  EXPECT_EQ(scene.camera.frame, CloudFrame::camera);
  EXPECT_EQ(scene.camera.unit, 0.001);
  EXPECT_EQ(scene.camera.depth_scale, 1000);
  ASSERT_TRUE(scene.support);
  EXPECT_EQ(scene.support->shape, Support::Shape::bin);
  EXPECT_EQ(scene.support->bin.height, 0.25);
  EXPECT_EQ(scene.support->margin, 0.004);
  EXPECT_TRUE(scene.support->pose.isApprox(Eigen::Isometry3d::Identity()));
  ASSERT_EQ(scene.tubes.size(), 1U);
  EXPECT_EQ(scene.tubes[0].radius, (LengthRange{0.006, 0.006}));
  EXPECT_EQ(scene.tubes[0].length, (LengthRange{0.244, 0.244}));
  EXPECT_TRUE(scene.tubes[0].flat_ends);
}

TEST(SceneFile, MayBeginWithAByteOrderMark) {
  std::istringstream in("\xEF\xBB\xBF[[tube]]\nradius = 0.01\n");
  EXPECT_EQ(read_scene(in, "scene.toml", "").tubes.at(0).radius, (LengthRange{0.01, 0.01}));
}

TEST(SceneFile, MayBeEmpty) {
  EXPECT_TRUE(is_empty(read("")));
  EXPECT_EQ(write(Scene{}), "");
}

TEST(SceneFile, ARadiusOrLengthMayBeARangeOrOpen) {
  const Scene scene = read(R"(
[[tube]]
radius = { min = 0.004, max = 0.008 }
length = { min = 0.2, max = 0.3 }
[[tube]]
radius = "auto"
[[tube]]
)");
  ASSERT_EQ(scene.tubes.size(), 3U);
  EXPECT_EQ(scene.tubes[0].radius, (LengthRange{0.004, 0.008}));
  EXPECT_EQ(scene.tubes[0].length, (LengthRange{0.2, 0.3}));
  for (const std::size_t open : {1U, 2U}) {
    EXPECT_FALSE(scene.tubes[open].radius);
    EXPECT_FALSE(scene.tubes[open].length);
  }
}

TEST(SceneFile, ATreeHasSegmentsAsInRecipes) {
  const Scene scene = read(R"(
[[tube]]
radius = 0.01
[[tube.segment]]
from = 1
to = 2
length = 0.3
[[tube.segment]]
from = 1
to = 3
length = 0.1
)");
  EXPECT_EQ(scene.tubes.at(0).tree, (SegmentTree{{1, 2, 0.3}, {1, 3, 0.1}}));
}

TEST(SceneFile, APresetIsACameraAndItsPoseWhichOtherKeysChange) {
  const Scene scene = read("[camera]\npreset = \"zivid-one-plus-l\"\nposition = [0.1, 0, 1]\n");
  EXPECT_EQ(scene.camera.intrinsics, intrinsics_of(camera_preset("zivid-one-plus-l")));
  EXPECT_EQ(scene.camera.pose->translation(), Eigen::Vector3d(0.1, 0, 1));
  EXPECT_EQ(scene.camera.pose->linear(), camera_preset("paper").pose.linear());
}

TEST(SceneFile, UpSaysHowALevelCameraIsHeld) {
  const Scene scene = read("[camera]\nposition = [1, 0, 0.5]\nlook_at = [0, 0, 0.5]\nup = [0, 0, 1]\n");
  const Eigen::Matrix3d rotation = scene.camera.pose->linear();
  EXPECT_TRUE(rotation.col(2).isApprox(-Eigen::Vector3d::UnitX())) << rotation;
  EXPECT_TRUE(rotation.col(1).isApprox(-Eigen::Vector3d::UnitZ())) << rotation;  // down in the image
  EXPECT_TRUE(rotation.isUnitary());
  EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
}

TEST(SceneFile, ABinUnderACameraIsToldByItsPlaceAndWhereUpIs) {
  const Scene scene = read(R"(
[support]
shape = "bin"
preset = "paper"
position = [0.1, 0.2, 1.5]
up = [0, 0, -1]
)");
  const Eigen::Isometry3d pose = scene.support->pose;
  EXPECT_TRUE((pose * Eigen::Vector3d(0.2, 0.1, 0.3)).isApprox(Eigen::Vector3d(0.3, 0.1, 1.2)));
  const Scene turned =
      read("[support]\nshape = \"plane\"\nposition = [0, 0, 1]\nup = [0, 0, 1]\nyaw_deg = 90\n");
  EXPECT_TRUE((turned.support->pose * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0, 1, 1)));
}

TEST(SceneFile, ACameraFileIsBesideTheSceneFile) {
  const test::TemporaryDirectory directory;
  test::write_bytes(directory / "camera.json",
                    R"({"cx": 319.5, "cy": 241, "fx": 585.5, "fy": 586, "height": 480, "width": 640})");
  test::write_bytes(directory / "scene.toml",
                    "[camera]\nfile = \"camera.json\"\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\n");
  const Scene scene = read_scene(directory / "scene.toml");
  EXPECT_EQ(scene.camera.intrinsics, (Intrinsics{640, 480, 585.5, 586, 319.5, 241}));
  EXPECT_EQ(scene.camera.pose->translation(), Eigen::Vector3d(0, 0, 1));
  test::write_bytes(directory / "other.toml", "\n[camera]\nfile = \"nowhere.json\"\n");
  EXPECT_THAT(complaint([&] { read_scene(directory / "other.toml"); }),
              testing::AllOf(HasSubstr("other.toml:3: "), HasSubstr("nowhere.json: cannot be opened")));
}

TEST(SceneFile, ErrorsNameLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"[cameras]\n", "scene.toml:1: unknown key 'cameras', did you mean 'camera'?"},
      {"[camera]\nfocal = 3\n", "scene.toml:2: camera: unknown key 'focal', did you mean 'focal_length_px'?"},
      {"[camera]\nwidth = 640\n", "scene.toml:1: camera.height: is missing"},
      {"[camera]\nwidth = 640\nheight = 480\n", "camera.fx: is missing"},
      {"[camera]\nfx = 500\nfy = 500\n", "camera.cx: is missing"},
      {"[camera]\nwidth = 640\nheight = 480\nfx = 500\nfy = -1\n",
       "scene.toml:5: camera.fy: found -1, expected a finite positive number"},
      {"[camera]\nhfov_deg = 46\n", "camera.width: is missing"},
      {"[camera]\nposition = [0, 0, 1]\n", "camera.look_at: is missing"},
      {"[camera]\nlook_at = [0, 0, 1]\n", "camera.position: is missing"},
      {"[camera]\nup = [0, 0, 1]\ncamera_to_world = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n",
       "camera.look_at"},
      {"[camera]\ncamera_to_world = [[1,0,0,0],[0,1,0,0],[0,0,1,0]]\n",
       "scene.toml:2: camera.camera_to_world: found an array of 3, expected an array of 4 rows"},
      {"[camera]\ncamera_to_world = [[1,0,0,0],[0,2,0,0],[0,0,1,0],[0,0,0,1]]\n",
       "scene.toml:2: camera.camera_to_world: found a matrix that is no rigid motion"},
      {"[camera]\nposition = [0,0,1]\nlook_at = [0,0,0]\ncamera_to_world = []\n", "cannot be combined"},
      {"[camera]\nfile = \"a\"\nfx = 3\n", "camera.fx: cannot be combined with file"},
      {"[camera]\nimage = 3\n", "camera.file: is missing"},
      {"[camera]\npreset = \"papers\"\n",
       "scene.toml:2: camera.preset: found 'papers', did you mean 'paper'?"},
      {"[camera]\nframe = \"robot\"\n",
       "scene.toml:2: camera.frame: found 'robot', expected \"camera\" or \"world\""},
      {"[camera]\nunit = \"cm\"\n", "camera.unit: found 'cm', expected \"m\" or \"mm\""},
      {"[camera]\ndepth_scale = 0\n", "scene.toml:2: camera.depth_scale: found 0"},
      {"[support]\nlength = 1\n", "support.shape: is missing"},
      {"[support]\nshape = \"box\"\n",
       "scene.toml:2: support.shape: found 'box', expected \"bin\", \"plane\" or \"nothing\""},
      {"[support]\nshape = \"bin\"\nlength = 0.6\nwidth = 0.4\n", "support.height: is missing"},
      {"[support]\nshape = \"bin\"\nlength = 600\nwidth = 400\nheight = 250\n",
       "scene.toml:3: support.length: found 600 m, expected 0.02 to 10 m; for 600 mm write 0.6"},
      {"[support]\nshape = \"plane\"\nlength = 1\n", "support: unknown key 'length'"},
      {"[support]\nshape = \"nothing\"\nposition = [0, 0, 1]\n", "support: unknown key 'position'"},
      {"[support]\nshape = \"plane\"\nup = [1, 0, 0]\n", "support.up: found no direction, or one along"},
      {"[support]\nshape = \"plane\"\nup = [0, 0, 1]\nrotation_wxyz = [1, 0, 0, 0]\n", "cannot be combined"},
      {"[support]\nshape = \"plane\"\nmargin = 4\n",
       "scene.toml:3: support.margin: found 4 m, expected 0 to 0.1 m; for 4 mm write 0.004"},
      {"[[tube]]\nradius = 6\n",
       "scene.toml:2: tube[0].radius: found 6 m, expected 0.0001 to 1 m; for 6 mm write 0.006"},
      {"[[tube]]\nradius = \"six\"\n",
       "scene.toml:2: tube[0].radius: found 'six', expected a number, m; a range"},
      {"[[tube]]\nradius = { min = 0.01 }\n", "tube[0].radius.max: is missing"},
      {"[[tube]]\nradius = { min = 0.02, max = 0.01 }\n",
       "tube[0].radius: found min = 0.02 and max = 0.01, expected a min of at most max"},
      {"[[tube]]\nradius = 0.01\nlength = 0\n", "tube[0].length: found 0 m"},
      {"[[tube]]\nradius = 0.01\n[[tube]]\nradius = 0.01\n",
       "scene.toml:4: tube[1].radius: found 0.01 m for two kinds, expected a different radius for each"},
      {"[support]\nshape = \"bin\"\npreset = \"paper\"\n[[tube]]\nradius = 0.0125\nlength = 480\n",
       "scene.toml:6: tube[0].length: found 480 m, expected at most 6.92 m, ten times the bin's diagonal; "
       "for 480 mm write 0.48"},
      {"[support]\nshape = \"bin\"\npreset = \"paper\"\n[[tube]]\nradius = 0.2\n",
       "scene.toml:5: tube[0].radius: found 0.2 m, expected less than 0.185 m"},
      {"[[tube]]\nradius = 0.01\nends = \"sharp\"\n",
       "tube[0].ends: found 'sharp', expected \"round\" or \"flat\""},
      {"[[tube]]\nlength = 1\n[[tube.segment]]\nfrom = 1\nto = 2\nlength = 1\n",
       "cannot be combined with length"},
      {"[[tube]]\n[[tube.segment]]\nfrom = 1\nto = 1\nlength = 1\n",
       "tube[0].segment: found a segment to node 1"},
      {"[tube]\nradius = 0.01\n", "tube: found a table, expected an array of tables [[tube]]"},
      {"[camera\n", "scene.toml:1: "},
      {"[support]\nshape = \"bin\"\nlength = 0.6\nwidth = 0.4\nheight = 0.2\nwall = 8\n",
       "scene.toml:6: support.wall: found 8 m, expected at most 0.5 m; for 8 mm write 0.008"},
      {"[support]\nshape = \"bin\"\npreset = \"paper\"\nwall = 0.6\n",
       "support.wall: found 0.6 m, expected at most 0.5 m"},
  };
  const auto complaint_of = [](const std::string& text) { return complaint([&] { read(text); }); };
  for (const auto& [text, message] : faults) EXPECT_THAT(complaint_of(text), HasSubstr(message)) << text;
}

// Numbers of every size, in few and in many digits.
rc::Gen<double> number(double least, double most) {
  return rc::gen::map(rc::gen::inRange(0, 1 << 30),
                      [=](int part) { return least + (most - least) * part / (1 << 30); });
}

Eigen::Isometry3d any_pose() {
  const auto axis = Eigen::Vector3d(*number(-1, 1), *number(-1, 1), *number(0.1, 1)).normalized();
  Eigen::Isometry3d pose(Eigen::AngleAxisd(*number(0, std::numbers::pi), axis));
  pose.translation() = Eigen::Vector3d(*number(-3, 3), *number(-3, 3), *number(-3, 3));
  return pose;
}

LengthRange any_range(double least, double most) {
  const double low = *number(least, most);
  return {low, *rc::gen::arbitrary<bool>() ? low : *number(low, most)};
}

Scene any_scene() {
  const auto maybe = [] { return *rc::gen::arbitrary<bool>(); };
  Scene scene;
  if (maybe())
    scene.camera.intrinsics = {*rc::gen::inRange(1, 8000), *rc::gen::inRange(1, 8000), *number(1, 5000),
                               *number(1, 5000),           *number(-10, 4000),         *number(-10, 4000)};
  if (scene.camera.intrinsics && maybe())
    scene.camera.intrinsics->width = scene.camera.intrinsics->height = 0;
  if (maybe()) scene.camera.pose = any_pose();
  if (maybe()) scene.camera.frame = maybe() ? CloudFrame::camera : CloudFrame::world;
  if (maybe()) scene.camera.unit = maybe() ? 1 : 0.001;
  if (maybe()) scene.camera.depth_scale = *number(0.01, 20000);
  if (maybe()) {
    scene.support = Support{.shape = *rc::gen::element(Support::Shape::bin, Support::Shape::plane)};
    if (scene.support->shape == Support::Shape::bin)
      // At least 0.35 m across: the reader refuses more than ten diagonals, and a tree may have 3 m.
      scene.support->bin = {.length = *number(0.25, 10),
                            .width = *number(0.25, 10),
                            .height = *number(0.01, 10),
                            .wall = *number(0.001, 0.5)};
    if (maybe()) scene.support->pose = any_pose();
    if (maybe()) scene.support->margin = *number(0, 0.1);
  } else if (maybe()) {
    scene.support = Support{.shape = Support::Shape::nothing};
  }
  const int classes = *rc::gen::inRange(0, 4);
  for (int i = 0; i < classes; ++i) {
    TubeClass tubes{.flat_ends = maybe()};
    if (maybe()) tubes.radius = any_range(0.001, 0.06);
    if (maybe()) {
      tubes.length = any_range(0, 2);
      tubes.length->max += 0.01;
    } else if (maybe()) {
      tubes.tree = {{1, 2, *number(0.1, 1)}, {1, 3, *number(0.1, 1)}, {2, 4, *number(0.1, 1)}};
    }
    scene.tubes.push_back(tubes);
  }
  return scene;
}

TEST(SceneFile, ReadsBackAsItWasWritten) {
  const bool holds = rc::check([] {
    const Scene scene = any_scene();
    const std::string text = write(scene);
    const Scene back = read(text);
    RC_ASSERT(write(back) == text);  // every number in all its digits
    RC_ASSERT(back.camera.intrinsics == scene.camera.intrinsics);
    RC_ASSERT(back.camera.pose.has_value() == scene.camera.pose.has_value());
    if (scene.camera.pose) RC_ASSERT(back.camera.pose->matrix() == scene.camera.pose->matrix());
    RC_ASSERT(back.support.has_value() == scene.support.has_value());
    if (scene.support) RC_ASSERT(back.support->pose.matrix() == scene.support->pose.matrix());
    if (scene.support) RC_ASSERT(back.support->bin == scene.support->bin);
    RC_ASSERT(back.tubes == scene.tubes);
  });
  EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace tanglebin
