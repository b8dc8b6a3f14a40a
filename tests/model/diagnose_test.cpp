#include "tanglebin/model/diagnose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/mistakes.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::Mistake;
using test::organized;
using test::right_view;
using test::View;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings)
    text += (finding.severity == Finding::Severity::error ? "error " : "warning ") + finding.code + ": " +
            finding.message + "\n";
  return text;
}

Model model_of(const View& view) {
  PointCloud cloud = view.cloud;
  cloud.labels.clear();
  cloud.colors.clear();
  return model_tubes(cloud, view.scene);
}

// Of a scan in which one point of eight is at this place.
Model model_with_every_eighth_at(const Vector3f& place) {
  View view = right_view();
  for (std::size_t i = 0; i < view.cloud.points.size(); i += 8) view.cloud.points[i] = place;
  return model_of(view);
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
  for (const Mistake& mistake : test::mistakes()) {
    View view = right_view();
    mistake.make(view);
    const Model model = model_of(view);
    const bool is_said = std::ranges::any_of(model.findings, [&](const Finding& finding) {
      return finding.code == mistake.code && finding.severity == mistake.severity &&
             finding.message.find(mistake.words) != std::string::npos;
    });
    EXPECT_TRUE(is_said) << mistake.name << ": " << model.tubes.size() << " tubes\n"
                         << text_of(model.findings);
    EXPECT_TRUE(model.is_refused() || mistake.severity == Finding::Severity::warning) << mistake.name;
    EXPECT_FALSE(model.findings.empty()) << mistake.name;
  }
}

TEST(Diagnose, NamesTheScaleOfADepthImage) {
  for (const double factor : {10.0, 0.1, 0.001, 0.5, 5.0}) {
    View view = right_view();
    view.cloud = organized();
    const Eigen::Isometry3d& camera = view.scene.camera.pose;
    test::move(view.cloud, camera * Eigen::Affine3d(Eigen::Scaling(factor)) * camera.inverse());
    view.cloud.depth_scale = 1000;
    EXPECT_THAT(text_of(model_of(view).findings),
                ContainsRegex("error unit: .*; they would fit with depth_scale = " +
                              std::to_string(static_cast<int>(1000 * factor)) + " in .camera.\n"))
        << factor;
  }
}

TEST(Diagnose, NeverSaysAllOrHundredPercentOfAPart) {
  View view = right_view();
  for (std::size_t i = 1; i < view.cloud.points.size(); ++i) view.cloud.points[i] = {2, 2, 0};
  EXPECT_THAT(text_of(model_of(view).findings),
              HasSubstr("99.9 % of the points are outside of the camera's"));
  view.cloud.points[0] = {2, 2, 0};
  EXPECT_THAT(text_of(model_of(view).findings), HasSubstr("all of the points are outside of the camera's"));
}

TEST(Diagnose, SaysIfNothingWasLookedAt) {
  const View view = right_view();
  EXPECT_THAT(
      text_of(model_tubes(view.cloud, view.scene, {.ratio = 1e-9}).findings),
      ContainsRegex("none of the [0-9]+ points that may be on tubes was looked at, at a ratio of 1e-09: "
                    "downsample less"));
}

TEST(Diagnose, BlamesTheDownsamplingBeforeTheRadius) {
  const View view = right_view();
  const Model model = model_tubes(view.cloud, view.scene, {.ratio = 0.001});
  EXPECT_THAT(text_of(model.findings),
              HasSubstr("none of the " + std::to_string(model.filtered.size()) +
                        " points looked at, at a ratio of 0.001, is on a tube of radius 12.5 mm: downsample "
                        "less\n"));
  EXPECT_LT(model.filtered.size(), 500U);
}

TEST(Diagnose, SaysNothingOfTheSupportIfThePointsAreElsewhere) {
  for (const Mistake& mistake : test::mistakes()) {
    if (mistake.code != "frame" && mistake.code != "axes") continue;
    View view = right_view();
    mistake.make(view);
    EXPECT_THAT(text_of(model_of(view).findings), Not(HasSubstr("stand for nothing measured")))
        << mistake.name;
  }
}

TEST(Diagnose, RealColoursAndTheColoursOfLabelsAreNoMistake) {
  View view = right_view();
  const Model model = model_tubes(view.cloud, view.scene);
  EXPECT_EQ(text_of(model.findings), "");
  EXPECT_EQ(model.labels, model_of(view).labels);
}

// Some drivers write a place far away where nothing was measured. A hundred times smaller, such a scan would
// be a spot on the floor, and wider than a tube only because of these.
TEST(Diagnose, SaysThatTheCameraCannotSeePlacesThatStandForNothing) {
  const Model model = model_with_every_eighth_at({0, 0, 10});
  EXPECT_EQ(
      text_of(model.findings),
      "warning camera: 13 % of the points are behind the camera, where it cannot have seen them: they are "
      "null\n");
  EXPECT_EQ(model.tubes.size(), 4U);
}

TEST(Diagnose, SaysThatTheFloorHidesWhatIsUnderIt) {
  const Model model = model_with_every_eighth_at({0, 0, -10});
  EXPECT_EQ(
      text_of(model.findings),
      "warning bin: 13 % of the points are under the bin's floor, 10 m deep in the median, where the camera "
      "cannot have seen them: do they stand for nothing measured? They are null\n");
  EXPECT_EQ(model.tubes.size(), 4U);
}

// A table of 0.4 x 0.3 m, 0.7 m above the floor of the room. The camera turned about would see more of the
// scene.
TEST(Diagnose, TakesWhatIsSeenBesideATableForTheFloorOfTheRoom) {
  View view = right_view();
  view.scene.support = {.shape = Support::Shape::plane};
  const Vector3f eye = view.scene.camera.pose.translation().cast<float>();
  for (std::size_t i = 0; i < view.cloud.points.size(); ++i) {
    Vector3f& point = view.cloud.points[i];
    const bool is_on_table = std::abs(point.x()) < 0.2F && std::abs(point.y()) < 0.15F && point.z() < 0.001F;
    if (view.cloud.labels[i] == bin_label && !is_on_table)
      point = eye + (point - eye) * (eye.z() + 0.7F) / (eye.z() - point.z());
  }
  const Model model = model_of(view);
  EXPECT_EQ(model.tubes.size(), 4U);
  EXPECT_FALSE(model.is_refused());
  EXPECT_THAT(
      text_of(model.findings),
      ContainsRegex("^warning support: [5-9][0-9] % of the points are under the plane, 0.7 m deep in "
                    "the median, but the tubes above it look right: is that the floor of the room\\?"));
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

// Seen with noise, above and below its true height.
TEST(Diagnose, IsNotTroubledByTheTableThatTheBinStandsOn) {
  View view = right_view();
  const Bin& bin = view.scene.support.bin;
  const PointCounts before = model_of(view).counts;
  const auto wall = static_cast<float>(bin.wall);
  const auto x = static_cast<float>(bin.length / 2 + bin.wall);
  for (int i = 0; i < 10'000; ++i) {
    const auto along = static_cast<float>(i % 100) * 0.002F;
    const auto across = static_cast<float>(i / 100) * 0.002F;
    view.cloud.points.emplace_back(x + 0.02F + along, across - 0.1F,
                                   -wall + (i % 2 == 0 ? 0.0005F : -0.0005F));
  }
  view.cloud.width = view.cloud.points.size();
  const Model model = model_of(view);
  EXPECT_GT(model.counts.below_support, before.below_support + 5'000) << "in the image";
  EXPECT_EQ(model.counts.unexplained, before.unexplained);
  EXPECT_EQ(text_of(model.findings), "");
}

// Such as a rack: a rail beside the bin is no tube, and nobody has to explain it. Nor is one that is higher
// than the rim, but so far away that a tube would fall out of the bin.
TEST(Diagnose, IsNotTroubledByWhatStandsBesideTheBin) {
  View view = right_view();
  const Bin& bin = view.scene.support.bin;
  const auto radius = static_cast<float>(view.scene.kinds.front().radius);
  const Model before = model_of(view);
  constexpr int points = 3'000;
  struct Rail {
    float outside;  // m, from the wall's inner side
    float height;   // m
  };
  for (const auto& [outside, height] : {Rail{0.1F, 0.1F}, Rail{0.3F, 0.25F}}) {
    SCOPED_TRACE(testing::Message() << outside << " m outside, " << height << " m high");
    View with_rail = view;
    for (int i = 0; i < points; ++i) {
      const float along = static_cast<float>(i % 150) * 0.002F - 0.15F;
      const float around = (static_cast<float>(i / 150) + 0.5F) / (points / 150) * 3.14F;
      with_rail.cloud.points.emplace_back(
          static_cast<float>(bin.length) / 2 + outside + radius * std::cos(around), along,
          height + radius * std::sin(around));
    }
    with_rail.cloud.width = with_rail.cloud.points.size();
    const Model model = model_of(with_rail);
    EXPECT_EQ(model.tubes.size(), before.tubes.size());
    EXPECT_EQ(model.counts.unexplained, before.counts.unexplained);
    EXPECT_EQ(model.counts.cropped + model.counts.outside_image,
              before.counts.cropped + before.counts.outside_image + points);
    EXPECT_EQ(text_of(model.findings), "");
  }
}

TEST(Diagnose, CountsNoPointOfAThinNoisyFloorAsUnderIt) {
  View view = right_view();
  view.scene.support.bin.wall = 0.002;
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.0015F);
  for (Vector3f& point : view.cloud.points) point.z() += noise(random);
  const auto deep =
      std::ranges::count_if(view.cloud.points, [](const Vector3f& point) { return point.z() < -0.006F; });
  EXPECT_LE(model_of(view).counts.below_support, static_cast<std::size_t>(deep));
}

// Of the four sides of its rim, the scanner measured one.
TEST(Diagnose, IsNotTroubledByARimThatWasNotMeasured) {
  View view = right_view();
  const Bin& bin = view.scene.support.bin;
  for (Vector3f& point : view.cloud.points) {
    const bool is_on_a_side_that_is_lost = point.x() > -bin.length / 2 + 0.02;
    if (is_on_a_side_that_is_lost && point.z() > bin.height - 0.05) point.setConstant(nan);
  }
  EXPECT_EQ(text_of(model_of(view).findings), "");
}

TEST(Diagnose, DoesNotTakeNoiseForAnotherRadius) {
  View view = right_view();
  const Vector3d camera = view.scene.camera.pose.translation();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.003);
  for (Vector3f& point : view.cloud.points) {
    const Vector3d seen = point.cast<double>();
    point = (seen + noise(random) * (seen - camera).normalized()).cast<float>();
  }
  const std::string text = text_of(model_of(view).findings);
  EXPECT_THAT(text, HasSubstr("noise: "));
  EXPECT_THAT(text, Not(HasSubstr("radius: ")));
}

TEST(Diagnose, WhatTheCameraCannotHaveSeenIsNullEvenOnTheBin) {
  View view = right_view();
  view.scene.camera.width /= 2;  // sees the left half
  const Model model = model_of(view);
  std::size_t on_bin = 0;
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    const bool is_seen = pixel_of(view.scene.camera, view.cloud.points[i].cast<double>()).has_value();
    EXPECT_TRUE(is_seen || model.labels[i] == null_label);
    if (model.labels[i] == bin_label) ++on_bin;
  }
  EXPECT_GT(on_bin, model.labels.size() / 10);
}

// Of half the size, so that the backs of the tubes are less than 20 mm above the plane.
TEST(Diagnose, DoesNotTakeTubesForTheFloorThatTheyHide) {
  View view = right_view();
  for (std::size_t i = 0; i < view.cloud.points.size(); ++i) {
    if (view.cloud.labels[i] == bin_label) view.cloud.points[i].setConstant(nan);
  }
  test::move(view.cloud, Eigen::Affine3d(Eigen::Scaling(0.5)));
  view.scene.camera.pose.translation() *= 0.5;
  view.scene.kinds[0].radius *= 0.5;
  view.scene.kinds[0].segments[0].length *= 0.5;
  view.scene.kinds[0].length_min *= 0.5;
  view.scene.support.shape = Support::Shape::plane;
  view.scene.support.pose.translation().z() = -0.004;
  EXPECT_EQ(text_of(model_of(view).findings), "");
}

TEST(Diagnose, SuggestsTheRadiusWhenNoTubeOfTheKnownOneIsThere) {
  View view = right_view();
  view.scene.kinds[0].radius = 0.04;
  const Model model = model_of(view);
  EXPECT_THAT(text_of(model.findings), HasSubstr("they look like tubes of radius 12."));
}

// Where tubes hide each other, most are seen in part.
TEST(Diagnose, DoubtsALengthOnlyIfHardlyATubeHasIt) {
  const View view = right_view();
  Model model = model_of(view);
  ASSERT_EQ(model.evidence.size(), 4U);
  for (TubeEvidence& tube : model.evidence) tube.length_fit = LengthFit::too_short;
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)), HasSubstr("4 of 4 tubes are shorter"));
  model.evidence[0].length_fit = LengthFit::complete;
  EXPECT_EQ(text_of(diagnose(view.cloud, view.scene, model, 1)), "");
}

TEST(Diagnose, DoesNotDoubtTheLengthOfTubesThatTheImageCutsOff) {
  const View view = right_view();
  Model model = model_of(view);
  for (TubeEvidence& tube : model.evidence) tube.length_fit = LengthFit::too_short;
  KnownScene scene = view.scene;
  for (const Tube& tube : model.tubes) {
    const auto end = project(scene.camera, tube.nodes.front().position);
    ASSERT_TRUE(end);
    scene.camera.width = std::min(scene.camera.width, static_cast<int>(end->x()) + 1);
  }
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)), HasSubstr("4 of 4 tubes are shorter"));
  EXPECT_THAT(text_of(diagnose(view.cloud, scene, model, 1)), Not(HasSubstr("shorter")));
}

// Between its ends, a tube may pass by the border.
TEST(Diagnose, DoubtsTheLengthOfTubesThatEndInTheImage) {
  const View view = right_view();
  Model model = model_of(view);
  for (TubeEvidence& tube : model.evidence) tube.length_fit = LengthFit::too_short;
  for (Tube& tube : model.tubes) {
    tube.nodes = {tube.nodes.front(), {3, {5, 5, 0}}, tube.nodes.back()};
    tube.edges = {{0, 1, 1}, {1, 2, 2}};
  }
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)), HasSubstr("4 of 4 tubes are shorter"));
}

TEST(Diagnose, DoesNotAskForTheFloorToBeOfTubesWhereNoneIsKnown) {
  View view = right_view();
  view.scene.support = {.shape = Support::Shape::nothing};
  const Model model = model_of(view);
  EXPECT_GT(model.counts.unexplained, model.counts.on_tubes);
  EXPECT_EQ(text_of(model.findings), "");
}

// Of tubes of half the radius, the surface is too curved everywhere, though most points are near it.
TEST(Diagnose, NamesTheRadiusOfTubesThatLookTooThin) {
  const View view = right_view();
  KnownScene scene = view.scene;
  scene.kinds[0].radius *= 2;
  Model model = model_of(view);
  for (TubeEvidence& tube : model.evidence) tube.radius_error = -0.1 * scene.kinds[0].radius;
  for (Tube& tube : model.tubes) tube.radius = scene.kinds[0].radius;
  EXPECT_THAT(text_of(diagnose(view.cloud, scene, model, 1)),
              HasSubstr("the tubes look like tubes of radius 12.5 mm, not 25 mm: is the radius right"));
}

TEST(Diagnose, NamesTheRadiiOfForeignTubes) {
  const View view = right_view();
  Model model = model_of(view);
  model.foreign_radii = {0.00404};
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)),
              HasSubstr("foreign: 1 tube has a radius of about 4 mm, not 12.5 mm: left out. Is it a foreign "
                        "part, or of a second kind of tube, to be declared as [[tube]]?"));
  model.foreign_radii = {0.004, 0.0183};
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)),
              HasSubstr("2 tubes have radii of about 4 to 18 mm, not 12.5 mm: left out. Are they foreign"));
}

TEST(Diagnose, AsksForOtherTubesWhereManyPointsAreOnNone) {
  const View view = right_view();
  Model model = model_of(view);
  model.counts.unexplained = model.counts.on_tubes / 2;
  EXPECT_THAT(
      text_of(diagnose(view.cloud, view.scene, model, 1)),
      HasSubstr("unexplained: 33 % of the points looked at are on no tube: are there other things, or tubes "
                "of another radius, to be declared as [[tube]]?\n"));
  model.foreign_radii = {0.004};
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)),
              HasSubstr("unexplained: 33 % of the points looked at are on no tube\n"));
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

// As where a floor or walls of which nothing is known are taken for tubes.
TEST(Diagnose, SaysThatHalfOfTheTubesAreProbablyWrong) {
  const View view = right_view();
  Model model = model_of(view);
  model.evidence[0].confidence = 0.4;
  EXPECT_EQ(text_of(diagnose(view.cloud, view.scene, model, 1)), "");
  model.evidence[1].confidence = 0.1;
  EXPECT_EQ(
      text_of(diagnose(view.cloud, view.scene, model, 1)),
      "warning confidence: 2 of 4 tubes are probably wrong: their confidence is below 0.5. Is the radius "
      "right, and is there anything but such tubes?\n");
  KnownScene nothing_known = view.scene;
  nothing_known.support.shape = Support::Shape::nothing;
  EXPECT_THAT(text_of(diagnose(view.cloud, nothing_known, model, 1)),
              HasSubstr("Give [support]: floor or walls may have been taken for tubes"));
}

// Where nothing is known of a support, noise on a floor may fall into thousands of pieces.
TEST(Diagnose, SaysThatThereAreTooManyPieces) {
  const View view = right_view();
  Model model = model_of(view);
  model.pieces_left_out = 12'000;
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)),
              testing::AllOf(HasSubstr("warning pieces: 12000 pieces"), Not(HasSubstr("[support]"))));
  KnownScene nothing_known = view.scene;
  nothing_known.support.shape = Support::Shape::nothing;
  EXPECT_THAT(text_of(diagnose(view.cloud, nothing_known, model, 1)), HasSubstr("Give [support]"));
}

// As where a tube is half hidden between two others, and each took a part of it.
TEST(Diagnose, SaysWhichTubesTheirPointsDoNotFit) {
  const View view = right_view();
  Model model = model_of(view);
  model.evidence[1].residual = 0.2 * model.tubes[1].radius;
  EXPECT_THAT(text_of(diagnose(view.cloud, view.scene, model, 1)),
              HasSubstr("warning fit: the points of tube 2 scatter by up to 20 % of the radius"));
  for (TubeEvidence& evidence : model.evidence) evidence.residual = 0.05 * model.tubes[0].radius;
  model.evidence[1].residual *= 4;
  EXPECT_EQ(text_of(diagnose(view.cloud, view.scene, model, 1)), "");
}

}  // namespace
}  // namespace tanglebin
