#include "tanglebin/scene/resolve_scene.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/pcd.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/scene/camera_file.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/simulate/simulate.hpp"
#include "tests/scan/scene.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/recipe_text.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int tubes = 10;

/// Ten tubes at rest in the paper's bin, seen by a tilted camera.
class ToldScene : public testing::Test {
protected:
  static const std::vector<Tube>& heap() {
    static const std::vector<Tube> settled = [] {
      std::istringstream recipe(test::recipe_text({.seed = 5, .width = 64, .tubes = "[10]", .cases = 1}));
      return simulate(read_recipe(recipe, "recipe.toml"), {"A", tubes, 1}).tubes;
    }();
    return settled;
  }
  static Camera camera() { return test::camera_at({0.3, -0.2, 1.3}, {0, 0, 0.02}, 960, 640, 0.55); }
  static const Scan& view() {
    static const Scan seen = scan(heap(), Bin{}, camera());
    return seen;
  }
  static PointCloud cloud() { return cloud_from_scan(view(), CloudOf::tubes_and_bin, tubes); }
  static PointCloud organized() { return organized_cloud_from_scan(view(), CloudOf::tubes_and_bin, tubes); }

  static PointCloud moved(PointCloud points, const Eigen::Affine3d& motion) {
    for (Eigen::Vector3f& point : points.points) point = (motion * point.cast<double>()).cast<float>();
    points.viewpoint.reset();
    return points;
  }
  static PointCloud in_camera_frame(PointCloud points) {
    return moved(std::move(points), Eigen::Affine3d(camera().pose.inverse().matrix()));
  }
  static PointCloud in_millimetres(PointCloud points) {
    return moved(std::move(points), Eigen::Affine3d(Eigen::Scaling(1000.0)));
  }

  /// Without a camera.
  static Scene bin_and_tubes() {
    return {.support = Support{},
            .tubes = {{.radius = LengthRange{0.0125, 0.0125}, .length = LengthRange{0.5, 0.5}}}};
  }
  static Scene with_camera(SceneCamera known) {
    Scene scene = bin_and_tubes();
    scene.camera = known;
    return scene;
  }
  static SceneCamera whole_camera() { return {.intrinsics = intrinsics_of(camera()), .pose = camera().pose}; }

  static double micro_recall(const Scene& scene, const PointCloud& points) {
    const ResolvedScene resolved = resolve(scene, points);
    return score(points.labels, model_tubes(resolved.cloud, resolved.known, {.ratio = 0.5}).labels)
        .micro_recall;
  }
};

TEST_F(ToldScene, HasTheSameLabelsHoweverItIsTold) {
  const double expected = micro_recall(with_camera(whole_camera()), cloud());
  EXPECT_GT(expected, 0.98);
  const SceneCamera pose_only{.pose = camera().pose};
  const Camera as_seen = camera();
  const std::string json = camera_json(as_seen);
  const std::vector<std::tuple<std::string, Scene, PointCloud>> ways = {
      {"in the camera's frame", with_camera(whole_camera()), in_camera_frame(cloud())},
      {"in millimetres", with_camera(whole_camera()), in_millimetres(cloud())},
      {"in millimetres, in the camera's frame", with_camera(whole_camera()),
       in_millimetres(in_camera_frame(cloud()))},
      {"organized, with a viewpoint", bin_and_tubes(), organized()},
      {"organized, in the camera's frame, with a pose", with_camera(pose_only), in_camera_frame(organized())},
      {"with a camera file", with_camera(read_camera_text(json, "camera.json")), in_camera_frame(cloud())}};
  for (const auto& [way, scene, points] : ways)
    EXPECT_NEAR(micro_recall(scene, points), expected, 0.0005) << way;
}

TEST_F(ToldScene, IsTheSameInTheCamerasFrameIfTheBinIsWhereTheCameraSeesIt) {
  Scene scene = bin_and_tubes();
  scene.camera.intrinsics = intrinsics_of(camera());
  scene.support->pose = camera().pose.inverse();
  const double expected = micro_recall(with_camera(whole_camera()), cloud());
  const ResolvedScene resolved = resolve(scene, in_camera_frame(cloud()));
  EXPECT_THAT(resolved.notes, Contains(HasSubstr("the world frame is the camera's")));
  EXPECT_NEAR(micro_recall(scene, in_camera_frame(cloud())), expected, 0.0005);
}

TEST_F(ToldScene, AllThatIsGivenIsTakenAsItIsAndNotedNowhere) {
  SceneCamera known = whole_camera();
  known.frame = CloudFrame::world;
  known.unit = 1;
  const ResolvedScene resolved = resolve(with_camera(known), cloud());
  EXPECT_THAT(resolved.notes, IsEmpty());
  EXPECT_EQ(resolved.cloud.points, cloud().points);
  EXPECT_EQ(resolved.known.camera, camera());
  EXPECT_EQ(resolved.known.kinds.at(0).length(), 0.5);
  EXPECT_EQ(resolved.known.kinds.at(0).length_min, 0.5);
}

TEST_F(ToldScene, AnOrganizedCloudShowsItsCamera) {
  const ResolvedScene resolved = resolve(bin_and_tubes(), organized());
  const Intrinsics found = intrinsics_of(resolved.known.camera);
  const Intrinsics expected = intrinsics_of(camera());
  EXPECT_EQ(found.width, expected.width);
  EXPECT_EQ(found.height, expected.height);
  EXPECT_NEAR(found.fx, expected.fx, 0.01);
  EXPECT_NEAR(found.fy, expected.fy, 0.01);
  EXPECT_NEAR(found.cx, expected.cx, 0.01);
  EXPECT_NEAR(found.cy, expected.cy, 0.01);
  EXPECT_TRUE(resolved.known.camera.pose.isApprox(camera().pose));
  EXPECT_THAT(resolved.notes,
              AllOf(Contains(HasSubstr("VIEWPOINT")), Contains(HasSubstr("taken to be in the world frame")),
                    Contains(HasSubstr("fitted to the organized cloud"))));
}

TEST_F(ToldScene, AnOrganizedCloudHasTheSizeThatACameraFileLacks) {
  Scene scene = with_camera({.intrinsics = intrinsics_of(camera())});
  scene.camera.intrinsics->width = scene.camera.intrinsics->height = 0;
  const ResolvedScene resolved = resolve(scene, in_camera_frame(organized()));
  EXPECT_EQ(intrinsics_of(resolved.known.camera), intrinsics_of(camera()));
  EXPECT_THAT(complaint([&] { resolve(scene, in_camera_frame(cloud())); }),
              HasSubstr("camera: found a camera without the size of its image"));
}

TEST_F(ToldScene, AnOrganizedCloudShowsThatTheCameraIsAnothers) {
  SceneCamera other = whole_camera();
  other.intrinsics->fx *= 0.5;
  other.intrinsics->fy *= 0.5;
  EXPECT_THAT(complaint([&] { resolve(with_camera(other), organized()); }),
              HasSubstr("which the organized cloud shows; is the camera another's?"));
  SceneCamera twice_as_fine = whole_camera();  // the cloud shows every other pixel of every other row
  twice_as_fine.intrinsics = {2 * camera().width, 2 * camera().height,   2 * camera().fx,
                              2 * camera().fy,    2 * camera().cx + 0.5, 2 * camera().cy + 0.5};
  EXPECT_NO_THROW(resolve(with_camera(twice_as_fine), organized()));
}

TEST_F(ToldScene, WhatIsNotKnownOfTheTubesIsEstimatedOrStaysOpen) {
  Scene scene = with_camera(whole_camera());
  scene.tubes.clear();
  const ResolvedScene resolved = resolve(scene, cloud());
  ASSERT_EQ(resolved.known.kinds.size(), 1U);
  EXPECT_NEAR(resolved.known.kinds[0].radius, 0.0125, 0.0005);
  EXPECT_FALSE(resolved.known.kinds[0].length_is_known());
  EXPECT_THAT(resolved.notes, AllOf(Contains(HasSubstr("the radius is estimated")),
                                    Contains(HasSubstr("length is not known"))));
  scene.tubes = {{}, {.radius = LengthRange{0.01, 0.01}}};
  EXPECT_THAT(complaint([&] { resolve(scene, cloud()); }),
              HasSubstr("tube[0].radius: found 2 classes of tubes"));
}

TEST_F(ToldScene, RangesOfLengthsHaveTheirEnds) {
  Scene scene = with_camera(whole_camera());
  scene.tubes = {{.radius = LengthRange{0.0125, 0.0125}, .length = LengthRange{0.4, 0.6}, .flat_ends = true}};
  const TubeKind kind = resolve(scene, cloud()).known.kinds.at(0);
  EXPECT_EQ(kind.length(), 0.6);
  EXPECT_EQ(kind.length_min, 0.4);
  EXPECT_TRUE(kind.flat_ends);
}

TEST_F(ToldScene, ALengthManyTimesTheSizeOfTheCloudIsRefused) {
  Scene scene = with_camera(whole_camera());
  for (const Support::Shape shape : {Support::Shape::plane, Support::Shape::nothing}) {
    scene.support->shape = shape;
    scene.tubes[0].length = LengthRange{244, 244};
    EXPECT_THAT(complaint([&] { resolve(scene, cloud()); }),
                AllOf(HasSubstr("tube[0].length: found 244 m, expected at most "),
                      HasSubstr("a hundred times the size of the cloud; for 244 mm write 0.244")));
    scene.tubes[0].length = LengthRange{0.2, 20};  // a coiled cable
    EXPECT_EQ(resolve(scene, cloud()).known.kinds.at(0).length(), 20);
  }
}

TEST_F(ToldScene, WhatTheCloudDoesNotShowMustBeSaid) {
  const Scene told = with_camera(whole_camera());
  Scene in_world = with_camera({.intrinsics = intrinsics_of(camera()), .frame = CloudFrame::world});
  PointCloud no_viewpoint = cloud();
  no_viewpoint.viewpoint.reset();
  PointCloud small_numbers = moved(cloud(), Eigen::Affine3d(Eigen::Scaling(0.001)));
  PointCloud aside = moved(cloud(), Eigen::Affine3d(Eigen::Translation3d(0, 0, -50)));
  PointCloud upside_down = in_camera_frame(organized());
  std::ranges::reverse(upside_down.points);
  PointCloud cut = in_camera_frame(organized());
  std::rotate(cut.points.begin(), cut.points.begin() + 960 * 320 + 480, cut.points.end());
  const std::vector<std::pair<std::string, std::string>> refusals = {
      {complaint([&] { resolve(bin_and_tubes(), cloud()); }),
       "camera: found neither the camera's intrinsics nor an organized cloud, which shows them, expected "
       "--camera FILE (of ROS, Open3D, BOP or `tanglebin scan --depth`), or a scene file with [camera]. For "
       "a cloud that is no camera's image (of a line scanner, merged from several views), describe a camera "
       "far above it (docs/real-scans.md)"},
      {complaint([&] { resolve(in_world, no_viewpoint); }),
       "camera: found points in the world frame, and nothing that says where the camera is"},
      {complaint([&] { resolve(with_camera({.intrinsics = intrinsics_of(camera())}), no_viewpoint); }),
       "camera: in the camera's frame, 1 % of the points are in the camera's image; if the cloud is in "
       "another"},
      {complaint([&] { resolve(told, small_numbers); }), "unit: found points within 0.0005"},
      {complaint([&] { resolve(told, aside); }),
       "frame: in the camera's frame, 0 % of the points are in the camera's image, and in the world frame, 0 "
       "%"},
      {complaint([&] { resolve(bin_and_tubes(), upside_down); }),
       "the image is upside down or mirrored: x should"},
      {complaint([&] { resolve(bin_and_tubes(), cut); }),
       "pixels from a pinhole camera's; if the cloud is in another"},
  };
  for (const auto& [refusal, message] : refusals) EXPECT_THAT(refusal, HasSubstr(message));
}

// Such as a depth buffer or a renderer's camera gives them: y up and z backwards.
TEST_F(ToldScene, NamesOpenGlsCameraFrame) {
  const Eigen::Affine3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  const PointCloud image = moved(in_camera_frame(organized()), turned);
  const PointCloud points = moved(in_camera_frame(cloud()), turned);
  const Scene without_pose = with_camera({.intrinsics = intrinsics_of(camera())});
  const Scene with_pose = with_camera({.pose = camera().pose});
  const Scene told_frame = with_camera({.pose = camera().pose, .frame = CloudFrame::camera});
  for (const std::string& refusal :
       {complaint([&] { resolve(bin_and_tubes(), image); }), complaint([&] { resolve(with_pose, image); }),
        complaint([&] { resolve(told_frame, image); }), complaint([&] { resolve(without_pose, points); })})
    EXPECT_EQ(
        refusal,
        "axes: found nearly all points behind the camera, if the cloud is in the camera's frame, expected "
        "x to the right, y down and z along the view; with y up and z backwards, as in OpenGL, they would "
        "fit: write (x, −y, −z) for each point (x, y, z), or give frame = \"world\" and OpenGL's "
        "camera_to_world (docs/real-scans.md)");
}

// The other remedy of these: OpenGL's frame is the world, and the camera in it looks along −z.
TEST_F(ToldScene, TakesOpenGlsCameraFrameForTheWorld) {
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  const PointCloud image = moved(in_camera_frame(organized()), Eigen::Affine3d(turned));
  Scene scene = with_camera({.pose = turned, .frame = CloudFrame::world});
  scene.support->pose = turned * camera().pose.inverse();
  EXPECT_GT(micro_recall(scene, image), 0.98);
}

TEST_F(ToldScene, NamesAPoseOfACameraThatLooksBackwards) {
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  PointCloud image = organized();
  image.viewpoint.reset();
  const Scene scene = with_camera({.pose = camera().pose * turned, .frame = CloudFrame::world});
  EXPECT_THAT(complaint([&] { resolve(scene, image); }),
              HasSubstr("they would fit: turn the camera's pose by 180° about its x axis"));
}

TEST_F(ToldScene, PointsThatAreNotThereDoNotCount) {
  PointCloud points = cloud();
  points.points.insert(points.points.begin(), 1000,
                       Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  points.points.front().x() = std::numeric_limits<float>::infinity();
  points.labels.insert(points.labels.begin(), 1000, null_label);
  points.width = points.points.size();
  points.colors.clear();
  const ResolvedScene resolved = resolve(with_camera(whole_camera()), in_millimetres(points));
  EXPECT_EQ(resolved.cloud.points.size(), points.points.size());
  EXPECT_THAT(resolved.notes, Contains(HasSubstr(" wide; its numbers are taken for millimetres")));
}

TEST_F(ToldScene, PointsWhereTheSensorIsWereNotMeasured) {
  PointCloud points = in_camera_frame(organized());
  for (Eigen::Vector3f& point : points.points) {
    if (!point.allFinite()) point.setZero();
  }
  const ResolvedScene resolved = resolve(bin_and_tubes(), points);
  EXPECT_THAT(resolved.notes, Contains(HasSubstr("points at exactly (0, 0, 0) are taken for not measured")));
  EXPECT_NEAR(resolved.known.camera.fx, camera().fx, 0.1);
  const auto is_zero = [](const Eigen::Vector3f& point) { return point.isZero(); };
  EXPECT_EQ(std::ranges::count_if(resolved.cloud.points, is_zero), 0);
}

// Of tubes of 1.25 mm, it finds none.
TEST_F(ToldScene, SaysWhichRadiiWereLookedFor) {
  Scene scene = with_camera({.intrinsics = intrinsics_of(camera()), .unit = 1});
  scene.support.reset();
  scene.tubes.clear();
  const PointCloud tiny = moved(in_camera_frame(cloud()), Eigen::Affine3d(Eigen::Scaling(0.1)));
  EXPECT_THAT(
      complaint([&] { resolve(scene, tiny); }),
      HasSubstr("; radii of 2 mm to 60 mm were looked for: give the radius, or another range, radius = { "
                "min, max } in [[tube]]"));
}

TEST_F(ToldScene, ARadiusThatTheCloudDoesNotShowIsRefused) {
  Scene scene = with_camera(whole_camera());
  for (const LengthRange& other : {LengthRange{0.004, 0.01}, LengthRange{0.014, 0.03}}) {
    scene.tubes = {{.radius = other}};
    EXPECT_THAT(complaint([&] { resolve(scene, cloud()); }), HasSubstr("radius: "));
  }
  scene.tubes = {{.radius = LengthRange{0.011, 0.014}}};
  EXPECT_NEAR(resolve(scene, cloud()).known.kinds.at(0).radius, 0.0125, 0.0005);
}

TEST(Overridden, ASupportSaysItselfWhetherItsWallIsGiven) {
  const Scene more{.support = Support{}, .wall_is_given = false};
  EXPECT_FALSE(overridden({}, more).wall_is_given);
  EXPECT_FALSE(overridden(more, {}).wall_is_given);
}

TEST_F(ToldScene, OfAnEmptyCloudNothingIsGuessed) {
  PointCloud empty;
  const ResolvedScene resolved = resolve(with_camera(whole_camera()), empty);
  EXPECT_TRUE(resolved.cloud.points.empty());
  EXPECT_THAT(resolved.notes, Each(Not(HasSubstr("millimetres"))));
}

TEST_F(ToldScene, TheEstimateOfARadiusEndsWhenAsked) {
  Scene scene = with_camera({});
  scene.tubes = {{}};
  int places = 0;
  const auto ask = [&] {
    if (++places == 3) throw std::runtime_error("asked");
  };
  EXPECT_THAT([&] { resolve(scene, organized(), ask); }, testing::ThrowsMessage<std::runtime_error>("asked"));
}

}  // namespace
}  // namespace tanglebin
