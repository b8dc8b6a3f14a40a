#include "tanglebin/model/axis/radius.hpp"

#include <gtest/gtest.h>

#include "tanglebin/base/random.hpp"
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

double estimated(const PointCloud& cloud) {
  return estimate_radius(cloud, test::paper_scene());
}

TEST(EstimateRadius, IsWithinTwoPercentWhateverTheRadius) {
  for (const double radius : {0.006, 0.008, 0.0125, 0.02, 0.03}) {
    EXPECT_NEAR(estimated(test::scanned(three_tubes(radius))) / radius, 1, 0.02) << radius;
  }
}

TEST(EstimateRadius, IsWithinTwoPercentOfANoisyCloud) {
  PointCloud cloud = test::scanned(three_tubes(0.0125));
  Rng rng(1);
  for (Eigen::Vector3f& point : cloud.points) {
    point.z() += static_cast<float>(uniform_real(rng, -0.0005, 0.0005));
  }
  EXPECT_NEAR(estimated(cloud) / 0.0125, 1, 0.02);
}

TEST(EstimateRadius, OfAnEmptyBinOrAPlaneIsAnError) {
  EXPECT_EQ(test::complaint([] { estimated(test::scanned({})); }),
            "radius: the cloud shows too little of a tube to estimate it; give the radius");
  std::vector<Eigen::Vector3f> plane;
  for (int i = 0; i < 10000; ++i) {
    plane.emplace_back(0.002F * static_cast<float>(i % 100) - 0.1F,
                       0.002F * static_cast<float>(i / 100) - 0.1F, 0.1F);
  }
  EXPECT_NE(test::complaint([&] { estimated(test::cloud_of(plane)); }), "none");
}

}  // namespace
}  // namespace tanglebin
