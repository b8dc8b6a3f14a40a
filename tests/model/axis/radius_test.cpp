#include "tanglebin/model/axis/radius.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tanglebin/base/random.hpp"
#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

// One tube lies straight, one is bent, one leans over both.
std::vector<Tube> three_tubes(double radius) {
  const double top = 3 * radius;
  return {test::chain(1, radius, {{-0.2, -0.1, radius}, {0.2, -0.1, radius}}),
          test::chain(2, radius, {{-0.2, 0.05, radius}, {0, 0.1, radius}, {0.2, 0.05, radius}}),
          test::chain(3, radius, {{0, -0.15, top}, {0.03, 0.15, top}})};
}

RadiusEstimate estimated(const PointCloud& cloud) {
  return estimate_radius(cloud, test::paper_scene());
}

KnownScene seen_without_support(const Camera& camera) {
  return {.support = {.shape = Support::Shape::nothing}, .camera = camera};
}

TEST(EstimateRadius, IsWithinAPercentFromAnUnknownStart) {
  for (const double radius : {0.006, 0.008, 0.0125, 0.02, 0.03, 0.05}) {
    const RadiusEstimate estimate = estimated(test::scanned(three_tubes(radius)));
    EXPECT_NEAR(estimate.radius / radius, 1, 0.01) << radius;
    EXPECT_LT(estimate.standard_error, 0.01 * radius) << radius;
    EXPECT_GE(estimate.places, 3U) << radius;
  }
}

TEST(EstimateRadius, IsWithinAPercentOfANoisyCloudAndTellsItsSpread) {
  PointCloud cloud = test::scanned(three_tubes(0.0125));
  const double without_noise = estimated(cloud).scatter;
  Rng rng(1);
  for (Eigen::Vector3f& point : cloud.points) {
    point.z() += static_cast<float>(uniform_real(rng, -0.0005, 0.0005));
  }
  const RadiusEstimate estimate = estimated(cloud);
  EXPECT_NEAR(estimate.radius / 0.0125, 1, 0.01);
  EXPECT_GT(estimate.scatter, 2 * without_noise);
  EXPECT_LT(estimate.scatter, 0.1 * 0.0125);
}

// The floor, the walls and their edges are in the cloud, and nothing is known of them.
TEST(EstimateRadius, DoesNotNeedTheSupport) {
  const PointCloud cloud = test::scanned(three_tubes(0.0125));
  EXPECT_NEAR(estimate_radius(cloud, seen_without_support(test::paper_scene().camera)).radius / 0.0125, 1,
              0.01);
}

TEST(EstimateRadius, DoesNotDependOnTheFrame) {
  PointCloud cloud = test::scanned(three_tubes(0.0125));
  KnownScene known = test::paper_scene();
  const double radius = estimate_radius(cloud, known).radius;
  known.support.pose =
      Eigen::Translation3d(1, -2, 0.5) * Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized());
  known.camera.pose = known.support.pose * known.camera.pose;
  for (Eigen::Vector3f& point : cloud.points)
    point = (known.support.pose * point.cast<double>()).cast<float>();
  EXPECT_NEAR(estimate_radius(cloud, known).radius, radius, 1e-5);
}

TEST(EstimateRadius, IsLookedForInTheRangeGiven) {
  const PointCloud cloud = test::scanned(three_tubes(0.0125));
  const KnownScene known = test::paper_scene();
  EXPECT_NEAR(estimate_radius(cloud, known, {0.01, 0.02}).radius / 0.0125, 1, 0.01);
  EXPECT_NE(test::complaint([&] { estimate_radius(cloud, known, {0.03, 0.05}); }), "none");
  EXPECT_EQ(test::complaint([&] {
              estimate_radius(cloud, known, {0.02, 0.01});
            }),
            "radius: found 0.02 to 0.01 m, expected a range within 0.0001 to 1 m");
}

TEST(EstimateRadius, OfTubesOfSeveralRadiiIsAnError) {
  std::vector<Tube> tubes = three_tubes(0.0125);
  tubes.push_back(test::chain(4, 0.02, {{-0.2, 0.15, 0.02}, {0.2, 0.15, 0.02}}));
  tubes.push_back(test::chain(5, 0.02, {{-0.2, -0.15, 0.02}, {0.2, -0.15, 0.02}}));
  EXPECT_THAT(test::complaint([&] { estimated(test::scanned(tubes)); }),
              testing::MatchesRegex("radius: the cloud shows tubes of several radii, of about 1[23] mm and "
                                    "20 mm; radii of 2 mm to 60 mm were looked for: give the radius, or "
                                    "another range, radius = \\{ min, max \\} in \\[\\[tube\\]\\]"));
}

TEST(EstimateRadius, OfTooLittleIsAnError) {
  const PointCloud floor = test::seen_by(test::small_camera(), {{0, test::wavy_floor(0, 1)}});
  EXPECT_THAT(test::complaint([&] {
                estimate_radius(floor, seen_without_support(test::small_camera()), {0.01, 0.123});
              }),
              testing::HasSubstr("too little of a tube of 10 mm to 123 mm radius"));
  EXPECT_EQ(
      test::complaint([] { estimated(test::scanned({})); }),
      "radius: the cloud shows too little of a tube to estimate it: 0 points that may be on one; radii of "
      "2 mm to 60 mm were looked for: give the radius, or another range, radius = { min, max } in "
      "[[tube]]");
  const KnownScene known = seen_without_support(test::small_camera());
  for (const test::Surface& surface :
       {test::wavy_floor(0, 1), test::box({-0.05, -0.05, 0}, {0.05, 0.05, 0.05}),
        test::ball({0, 0, 0}, 0.05)}) {
    const PointCloud cloud = test::seen_by(known.camera, {{0, surface}, {0, test::wavy_floor(0, 1)}});
    EXPECT_THAT(test::complaint([&] { estimate_radius(cloud, known); }),
                testing::StartsWith("radius: the cloud shows too little of a tube of 2 mm to 60 mm radius"));
  }
}

}  // namespace
}  // namespace tanglebin
