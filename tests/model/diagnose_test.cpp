#include "tanglebin/model/diagnose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using test::cloud_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A heap, as a tilted camera sees it, and what is known of it.
struct View {
  PointCloud cloud;
  KnownScene scene;
};

std::vector<Tube> heap() {
  const double r = test::radius;
  return {test::chain(1, r, {{-0.2, -0.05, r}, {-0.05, 0, r}, {0.1, 0, r}, {0.25, 0.06, r}}),
          test::chain(2, r, {{0.02, -0.1, r}, {0.02, 0, 0.06}, {0.03, 0.16, r}}),
          test::chain(3, r, {{-0.25, 0.12, r}, {-0.12, 0.15, r}, {-0.05, 0.1, r}, {0.15, 0.12, r}}),
          test::chain(4, r, {{-0.2, -0.15, r}, {0.2, -0.12, r}})};
}

View right_view() {
  View view;
  view.scene.support.bin = bin_preset("paper");
  view.scene.camera = test::camera_at({0.3, 0.2, 1.6}, {0, 0, 0}, 800, 600, 0.7);
  const Scan scan_of_heap = scan(heap(), view.scene.support.bin, view.scene.camera);
  view.cloud = cloud_from_scan(scan_of_heap, CloudOf::tubes_and_bin, 4);
  view.scene.kinds[0].segments = {{1, 2, 0.48}};
  view.scene.kinds[0].length_min = 0.36;
  return view;
}

PointCloud organized() {
  const View view = right_view();
  return organized_cloud_from_scan(scan(heap(), view.scene.support.bin, view.scene.camera),
                                   CloudOf::tubes_and_bin, 4);
}

void move(PointCloud& cloud, const Eigen::Affine3d& motion) {
  for (Vector3f& point : cloud.points) point = (motion * point.cast<double>()).cast<float>();
}

void change_axes(PointCloud& cloud, const Eigen::Matrix3d& axes) {
  move(cloud, Eigen::Affine3d(axes));
}

/// What is said of a mistake.
struct Verdict {
  std::string name;
  std::function<void(View&)> mistake;
  std::string code;
  Finding::Severity severity;
  std::string words;  ///< a part of the message
};

constexpr auto error = Finding::Severity::error;
constexpr auto warning = Finding::Severity::warning;

std::vector<Verdict> verdicts() {
  const auto to_camera = [](View& view) {
    move(view.cloud, Eigen::Affine3d(view.scene.camera.pose.inverse()));
  };
  const auto scale = [](double factor) {
    return [factor](View& view) { move(view.cloud, Eigen::Affine3d(Eigen::Scaling(factor))); };
  };
  const auto axes = [](const Vector3d& x, const Vector3d& y, const Vector3d& z) {
    return [=](View& view) {
      Eigen::Matrix3d rows;
      rows << x.transpose(), y.transpose(), z.transpose();
      change_axes(view.cloud, rows);
    };
  };
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  return {
      {"camera's frame", to_camera, "frame", error, "in the camera's frame: --frame camera"},
      {"told to be in the camera's frame",
       [](View& view) { move(view.cloud, Eigen::Affine3d(view.scene.camera.pose)); }, "frame", error,
       "in the world frame: --frame world"},
      {"millimetres", scale(1000), "unit", error, "in millimetres: --unit mm"},
      {"told to be in millimetres", scale(0.001), "unit", error, "in metres: --unit m"},
      {"camera's frame and millimetres",
       [=](View& view) {
         to_camera(view);
         scale(1000)(view);
       },
       "frame", error, "in millimetres: --unit mm"},
      {"z down", axes(x, -y, -z), "axes", error, "(x, −y, −z)"},
      {"y up", axes(x, z, -y), "axes", error, "(x, −z, y)"},
      {"x and y swapped, as in a mirror", axes(y, x, z), "axes", error, "if their ("},
      {"OpenGL's camera frame",
       [=](View& view) {
         to_camera(view);
         axes(x, -y, -z)(view);
       },
       "frame", error, "(x, −y, −z)"},
      {"pose inverted", [](View& view) { view.scene.camera.pose = view.scene.camera.pose.inverse(); },
       "camera", warning, "is its pose right?"},
      {"support upside down",
       [](View& view) {
         view.scene.support.pose = Isometry3d(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
       },
       "support", error, "turned by 180°"},
      {"another bin", [](View& view) { view.scene.support.bin = bin_preset("published"); }, "bin", warning,
       "of the bin's rim"},
      {"a smaller bin",
       [](View& view) {
         view.scene.support.bin.length = 0.4;
         view.scene.support.bin.width = 0.3;
       },
       "bin", warning, "bin"},
      {"the bin 10 mm too low", [](View& view) { view.scene.support.pose.translation().z() = -0.01; },
       "floor", warning, "the floor is 10.0 mm above"},
      {"twice the radius: the diameter", [](View& view) { view.scene.kinds[0].radius *= 2; }, "radius",
       warning, "they look like tubes of radius 12.5 mm"},
      {"half the radius", [](View& view) { view.scene.kinds[0].radius /= 2; }, "radius", error,
       "they look like tubes of radius 12.5 mm: --radius 0.0125"},
      {"half the length",
       [](View& view) {
         view.scene.kinds[0].segments = {{1, 2, 0.25}};
         view.scene.kinds[0].length_min = 0.2;
       },
       "length", warning, "longer than known"},
      {"twice the length",
       [](View& view) {
         view.scene.kinds[0].segments = {{1, 2, 1}};
         view.scene.kinds[0].length_min = 0.8;
       },
       "length", warning, "shorter than known"},
      {"the intrinsics of another resolution",
       [](View& view) {
         view.scene.camera.width /= 2;
         view.scene.camera.height /= 2;
       },
       "camera", error, "outside of the camera's image"},
      {"an organized cloud of another resolution",
       [](View& view) {
         view.cloud = organized();
         Camera& camera = view.scene.camera;
         camera = {.width = camera.width / 2,
                   .height = camera.height / 2,
                   .fx = camera.fx / 2,
                   .fy = camera.fy / 2,
                   .cx = camera.cx / 2,
                   .cy = camera.cy / 2,
                   .pose = camera.pose};
       },
       "camera", warning, "800 x 600 pixels"},
      {"another camera at the same place",
       [](View& view) {
         view.scene.camera.fx *= 2;
         view.scene.camera.fy *= 2;
         view.scene.camera.width *= 2;
         view.scene.camera.height *= 2;
         view.scene.camera.cx *= 2;
         view.scene.camera.cy *= 2;
       },
       "camera", warning, "no neighbour"},
      {"a mirrored cloud", axes(-x, y, z), "camera", warning, "at several depths"},
      {"a mirrored organized cloud",
       [=](View& view) {
         view.cloud = organized();
         view.scene.camera.pose.translation().y() = 0;
         axes(-x, y, z)(view);
       },
       "camera", warning, "pixels beside"},
      {"every point twice",
       [](View& view) {
         const std::vector<Vector3f> once = view.cloud.points;
         view.cloud.points.insert(view.cloud.points.end(), once.begin(), once.end());
         view.cloud.width *= 2;
       },
       "camera", warning, "2.0 points lie in each pixel"},
      {"an empty cloud", [](View& view) { view.cloud = {}; }, "empty", error, "no points"},
      {"only NaN",
       [](View& view) {
         view.cloud = cloud_of(std::vector<Vector3f>(50, {nan, nan, nan}));
       },
       "invalid", error, "none of the cloud's 50 points has a position"},
      {"only the bin",
       [](View& view) {
         view.cloud =
             cloud_from_scan(scan({}, view.scene.support.bin, view.scene.camera), CloudOf::tubes_and_bin, 0);
       },
       "no-tubes", error, "it looks empty"},
      {"one plane",
       [](View& view) {
         std::vector<Vector3f> points;
         for (int i = 0; i < 40'000; ++i)
           points.emplace_back(0.001F * static_cast<float>(i % 200) - 0.1F,
                               0.001F * static_cast<float>(i / 200) - 0.1F, 0.1F);
         view.cloud = cloud_of(points);
       },
       "no-tubes", error, "none of the 40000 points looked at"},
  };
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings)
    text +=
        (finding.severity == error ? "error " : "warning ") + finding.code + ": " + finding.message + "\n";
  return text;
}

Model model_of(const View& view) {
  PointCloud cloud = view.cloud;
  cloud.labels.clear();
  cloud.colors.clear();
  return model_tubes(cloud, view.scene);
}

TEST(Diagnose, SaysNothingOfASceneThatFits) {
  const Model model = model_of(right_view());
  EXPECT_EQ(model.tubes.size(), 4U);
  EXPECT_EQ(text_of(model.findings), "");
  EXPECT_FALSE(model.is_refused());
  View view = right_view();
  view.cloud = organized();
  EXPECT_EQ(text_of(model_of(view).findings), "");
}

TEST(Diagnose, SaysWhatIsWrongOnPurpose) {
  for (const Verdict& verdict : verdicts()) {
    View view = right_view();
    verdict.mistake(view);
    const Model model = model_of(view);
    const bool is_said = std::ranges::any_of(model.findings, [&](const Finding& finding) {
      return finding.code == verdict.code && finding.severity == verdict.severity &&
             finding.message.find(verdict.words) != std::string::npos;
    });
    EXPECT_TRUE(is_said) << verdict.name << ": " << model.tubes.size() << " tubes\n"
                         << text_of(model.findings);
    EXPECT_TRUE(model.is_refused() || verdict.severity == warning) << verdict.name;
    EXPECT_FALSE(model.findings.empty()) << verdict.name;
  }
}

TEST(Diagnose, RealColoursAndTheColoursOfLabelsAreNoMistake) {
  View view = right_view();
  const Model model = model_tubes(view.cloud, view.scene);
  EXPECT_EQ(text_of(model.findings), "");
  EXPECT_EQ(model.labels, model_of(view).labels);
}

TEST(Diagnose, CountsEveryPointOnce) {
  View view = right_view();
  std::vector<Vector3f>& points = view.cloud.points;
  const PointCounts before = model_of(view).counts;
  points.insert(points.end(), 3, {nan, 0, 0});
  points.insert(points.end(), 4, {0.3F, 0.2F, 1.7F});   // behind the camera
  points.insert(points.end(), 5, {2, 2, 0});            // beside its image
  points.insert(points.end(), 6, {0, 0, -1});           // under the floor
  points.insert(points.end(), 7, {0.2F, 0.15F, 1.2F});  // far above the bin
  view.cloud.width = points.size();
  const Model model = model_of(view);
  const PointCounts& after = model.counts;
  EXPECT_EQ(after.all, before.all + 25);
  EXPECT_EQ(after.invalid, 3U);
  EXPECT_EQ(after.behind_camera, 4U);
  EXPECT_EQ(after.outside_image, 5U);
  EXPECT_EQ(after.below_support, 6U);
  EXPECT_EQ(after.cropped, 7U);
  EXPECT_EQ(after.all, after.invalid + after.behind_camera + after.outside_image + after.below_support +
                           after.cropped + after.on_support + after.on_tubes + after.unexplained);
}

TEST(Diagnose, WhatTheCameraCannotHaveSeenIsNullEvenOnTheBin) {
  View view = right_view();
  view.scene.camera.width /= 2;  // sees the left half
  const Model model = model_of(view);
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    const bool is_seen = pixel_of(view.scene.camera, view.cloud.points[i].cast<double>()).has_value();
    EXPECT_TRUE(is_seen || model.labels[i] == null_label);
  }
}

TEST(Diagnose, SuggestsTheRadiusWhenNoTubeOfTheKnownOneIsThere) {
  View view = right_view();
  view.scene.kinds[0].radius = 0.04;
  const Model model = model_of(view);
  EXPECT_THAT(text_of(model.findings), HasSubstr("they look like tubes of radius 12."));
}

TEST(Diagnose, WarnsOfTooFewPointsAcrossATube) {
  const View view = right_view();
  const Model model = model_tubes(view.cloud, view.scene, {.ratio = 0.02});
  EXPECT_THAT(text_of(model.findings), HasSubstr("points lie across a tube"));
}

TEST(Diagnose, WarnsOfNoise) {
  View view = right_view();
  Rng rng(1);
  for (Vector3f& point : view.cloud.points) {
    const Vector3f ray = (point - view.scene.camera.pose.translation().cast<float>()).normalized();
    point += static_cast<float>(uniform_real(rng, -0.004, 0.004)) * ray;
  }
  EXPECT_THAT(text_of(model_of(view).findings), HasSubstr("scatter"));
}

}  // namespace
}  // namespace tanglebin
