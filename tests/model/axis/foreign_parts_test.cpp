#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::Thing;

constexpr std::int32_t label_of_tube = 1;
constexpr std::int32_t label_of_others = 2;

KnownScene scene_on(Support::Shape shape) {
  return {.support = {.shape = shape},
          .camera = test::near_camera(),
          .kinds = {{.radius = test::radius, .segments = {{1, 2, 0.3}}, .flat_ends = true}}};
}

// Each of these is labelled as `label_of_others`.
std::vector<Thing> foreign_parts() {
  return {{label_of_others, test::box({-0.15, 0.03, 0}, {-0.05, 0.11, 0.05})},
          {label_of_others, test::box({0.02, 0.05, 0}, {0.03, 0.12, 0.03})},
          {label_of_others, test::ball({0.1, 0.06, 0.03}, 0.03)},
          {label_of_others, test::ball({0.05, -0.11, test::radius}, test::radius)},
          {label_of_others, test::flat_cylinder({-0.12, -0.09, 0.04}, {0, -0.11, 0.04}, 0.03)}};
}

std::vector<Thing> a_tube_among_foreign_parts(const test::Surface& floor) {
  std::vector<Thing> things = foreign_parts();
  things.push_back({bin_label, floor});
  things.push_back(
      {label_of_tube, test::flat_cylinder({-0.15, -0.02, 0.0125}, {0.15, -0.03, 0.0125}, test::radius)});
  return things;
}

void expect_only_the_tube(const PointCloud& cloud, const Model& model) {
  ASSERT_EQ(model.tubes.size(), 1U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == label_of_tube) {
      ASSERT_EQ(model.labels[i], 1) << "at " << cloud.points[i].transpose();
    } else if (cloud.labels[i] == label_of_others) {
      ASSERT_EQ(model.labels[i], null_label) << "at " << cloud.points[i].transpose();
    }
  }
}

TEST(ForeignParts, OnATableStayUnexplained) {
  const PointCloud cloud =
      test::seen_by(test::near_camera(), a_tube_among_foreign_parts(test::wavy_floor(0, 1)));
  expect_only_the_tube(cloud, model_tubes(cloud, scene_on(Support::Shape::plane)));
}

TEST(ForeignParts, StayUnexplainedWhereTheSupportIsNotKnown) {
  const PointCloud cloud =
      test::seen_by(test::near_camera(), a_tube_among_foreign_parts(test::wavy_floor(0, 1)));
  expect_only_the_tube(cloud, model_tubes(cloud, scene_on(Support::Shape::nothing)));
}

// The paper's camera, tilted about the middle of the floor.
Camera paper_camera(double tilt_deg) {
  Camera camera = camera_preset("paper");
  camera.pose = Eigen::AngleAxisd(tilt_deg * degree, Eigen::Vector3d::UnitX()) * camera.pose;
  return camera;
}

bool is_sure(const TubeEvidence& tube) {
  return tube.confidence > 0.9;
}

// Of the points on sure tubes: how many are of the bin.
double false_share(const PointCloud& cloud, const Model& model) {
  double on_tubes = 0;
  double of_bin = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::int32_t label = model.labels[i];
    if (label <= 0 || !is_sure(model.evidence[static_cast<std::size_t>(label) - 1])) continue;
    ++on_tubes;
    if (cloud.labels[i] == bin_label) ++of_bin;
  }
  return of_bin / on_tubes;
}

// Two tubes in a bin of which nothing is known, from aslant: two sides of each wall are seen, about as wide
// as a tube, and all of the floor.
TEST(ForeignParts, OfABinThatIsNotKnownAreNoTubes) {
  const std::vector<Tube> tubes = {test::straight_tube(1, -0.05), test::straight_tube(2, 0.08)};
  for (const double tilt : {20.0, 30.0}) {
    const Camera camera = paper_camera(tilt);
    const PointCloud cloud =
        cloud_from_scan(scan(tubes, bin_preset("paper"), camera), CloudOf::tubes_and_bin, 2);
    const KnownScene known{.support = {.shape = Support::Shape::nothing}, .camera = camera};
    const Model model = model_tubes(cloud, known);
    EXPECT_EQ(std::ranges::count_if(model.evidence, is_sure), 2) << tilt << " degrees";
    EXPECT_LE(model.tubes.size(), 3U) << tilt << " degrees";
    EXPECT_LT(false_share(cloud, model), 0.01) << tilt << " degrees";
  }
}

// Three hoses side by side on the floor of the paper's bin, and across them a tube of this radius.
std::vector<Tube> hoses_and_one_across(double radius) {
  std::vector<Tube> tubes = {test::straight_tube(1, -0.08), test::straight_tube(2, 0),
                             test::straight_tube(3, 0.08)};
  const double height = 2 * test::radius + radius;
  tubes.push_back(test::chain(4, radius, {{0.02, -0.16, height}, {0.05, 0.16, height}}));
  return tubes;
}

void expect_unexplained(const PointCloud& cloud, const Model& model, std::int32_t label) {
  std::size_t null_points = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != label) continue;
    ++points;
    if (model.labels[i] == null_label) ++null_points;
  }
  EXPECT_GT(10 * null_points, 9 * points);
}

// In a bin that is not exactly a box, it does not look like any of the known tubes; in one that is, it does.
TEST(ForeignParts, ATubeOfAnotherRadiusStaysUnexplainedAndItsRadiusIsNamed) {
  for (const double margin : {0.0, 0.005}) {
    for (const double radius : {0.006, 0.018}) {
      SCOPED_TRACE(fmt::format("radius {}, margin {}", radius, margin));
      const PointCloud cloud = test::scanned(hoses_and_one_across(radius));
      KnownScene known = test::paper_scene();
      known.support.margin = margin;
      const Model model = model_tubes(cloud, known);
      ASSERT_EQ(model.tubes.size(), 3U);
      ASSERT_EQ(model.foreign_radii.size(), 1U);
      EXPECT_NEAR(model.foreign_radii[0], radius, 0.03 * radius);
      expect_unexplained(cloud, model, 4);
    }
  }
}

TEST(ForeignParts, ATubeOfAnyKnownRadiusIsNone) {
  KnownScene known = test::paper_scene();
  known.kinds.push_back({.radius = 0.018});
  const Model model = model_tubes(test::scanned(hoses_and_one_across(0.018)), known);
  EXPECT_EQ(model.tubes.size(), 4U);
  EXPECT_TRUE(model.foreign_radii.empty());
}

// The known radius is wrong, which is said in other words. To leave all tubes out would not help.
TEST(ForeignParts, AreNotAllTubes) {
  KnownScene known = test::paper_scene();
  known.kinds[0].radius = 0.016;
  const Model model = model_tubes(test::scanned(hoses_and_one_across(test::radius)), known);
  EXPECT_FALSE(model.tubes.empty());
  EXPECT_TRUE(model.foreign_radii.empty());
}

// Waves of 3 mm, like a sagging sheet.
TEST(ForeignParts, StayUnexplainedOnAFloorThatIsNotFlat) {
  const PointCloud cloud =
      test::seen_by(test::near_camera(), a_tube_among_foreign_parts(test::wavy_floor(0.003, 0.15)));
  expect_only_the_tube(cloud, model_tubes(cloud, scene_on(Support::Shape::plane)));
  expect_only_the_tube(cloud, model_tubes(cloud, scene_on(Support::Shape::nothing)));
}

}  // namespace
}  // namespace tanglebin
