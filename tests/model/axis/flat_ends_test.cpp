#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

KnownScene on_a_plane(double radius, double length) {
  return {.support = {.shape = Support::Shape::plane},
          .camera = test::near_camera(),
          .kinds = {{.radius = radius, .segments = {{1, 2, length}}, .flat_ends = true}}};
}

// How far the ends of a modelled tube are from those of the true one, at most.
double error_of_ends(const Tube& tube, const Vector3d& a, const Vector3d& b) {
  const Vector3d& first = tube.nodes[0].position;
  const Vector3d& second = tube.nodes[1].position;
  return std::min(std::max((first - a).norm(), (second - b).norm()),
                  std::max((first - b).norm(), (second - a).norm()));
}

std::ptrdiff_t count_of(const std::vector<std::int32_t>& labels, std::int32_t label) {
  return std::ranges::count(labels, label);
}

// Lying, and leaning so that more and more of the upper face is seen.
TEST(FlatEnds, AreWhereTheTubeIsCut) {
  for (const double radius : {0.006, 0.0125}) {
    for (const double lean : {0.0, 10.0, 30.0, 50.0, 60.0}) {
      const double angle = lean * test::degree;
      const Vector3d way(std::cos(angle), 0.2 * std::cos(angle), std::sin(angle));
      const Vector3d a(-0.1, -0.02, radius);
      const Vector3d b = a + 0.2 * way.normalized();
      const PointCloud cloud = test::seen_by(
          test::near_camera(), {{0, test::wavy_floor(0, 1)}, {1, test::flat_cylinder(a, b, radius)}});
      const Model model = model_tubes(cloud, on_a_plane(radius, 0.2));
      ASSERT_EQ(model.tubes.size(), 1U) << radius << ", leaning by " << lean;
      EXPECT_LT(error_of_ends(model.tubes[0], a, b), 0.1 * radius) << radius << ", leaning by " << lean;
      // On the edge of the cut, a point may be as near to the support.
      EXPECT_LE(std::abs(count_of(model.labels, 1) - count_of(cloud.labels, 1)), 1)
          << radius << ", leaning by " << lean;
    }
  }
}

// A bar that is bent by a right angle, with one leg upright: its face, and the leg that lies on the floor.
TEST(FlatEnds, OfAnUprightLegAreOneTubeWithTheRest) {
  constexpr double radius = 0.0125;
  const Vector3d corner(-0.05, 0, radius);
  const PointCloud cloud = test::seen_by(
      test::near_camera(), {{0, test::wavy_floor(0, 1)},
                            {1, test::flat_cylinder(corner, corner + Vector3d(0, 0, 0.08), radius)},
                            {1, test::flat_cylinder(corner, corner + Vector3d(0.12, 0, 0), radius)}});
  const Model model = model_tubes(cloud, on_a_plane(radius, 0.2));
  EXPECT_EQ(model.tubes.size(), 1U);
  EXPECT_GT(count_of(model.labels, 1), 0.98 * static_cast<double>(count_of(cloud.labels, 1)));
}

// What lies behind the cut, as near as a rounded end would reach, is not the tube's.
TEST(FlatEnds, LeaveWhatLiesBeyondThem) {
  const Vector3d a(-0.15, 0, 0.0125);
  const Vector3d b(0.05, 0, 0.0125);
  const PointCloud cloud =
      test::seen_by(test::near_camera(), {{0, test::wavy_floor(0, 1)},
                                          {1, test::flat_cylinder(a, b, 0.0125)},
                                          {2, test::box({0.052, -0.01, 0}, {0.08, 0.01, 0.02})}});
  const Model model = model_tubes(cloud, on_a_plane(0.0125, 0.2));
  ASSERT_EQ(model.tubes.size(), 1U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == 1) {
      ASSERT_EQ(model.labels[i], 1);
    }
    const bool is_beyond_reach = cloud.points[i].x() > 0.0635F;  // a radius behind the face
    if (cloud.labels[i] == 2 && is_beyond_reach) {
      ASSERT_EQ(model.labels[i], null_label);
    }
  }
}

}  // namespace
}  // namespace tanglebin
