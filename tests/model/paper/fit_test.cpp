#include "tanglebin/model/paper/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "tanglebin/base/random.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::radius;

// Points with true normals, spread evenly over the upper half of a cylinder from a to b.
void add_half_cylinder(OrientedCloud& cloud, const Vector3d& a, const Vector3d& b, int points, Rng& rng) {
  const Vector3d axis = (b - a).normalized();
  const Vector3d side = axis.cross(Vector3d::UnitZ()).normalized();
  const Vector3d up = side.cross(axis);
  for (int i = 0; i < points; ++i) {
    const double angle = uniform_real(rng, 0, std::numbers::pi);
    const Vector3d normal = std::cos(angle) * side + std::sin(angle) * up;
    const Vector3d point = a + uniform_real(rng, 0, 1) * (b - a) + radius * normal;
    cloud.points.emplace_back(point.cast<float>());
    cloud.normals.emplace_back(normal.cast<float>());
    cloud.curvatures.push_back(0.1F);
    cloud.indices.push_back(cloud.indices.size());
  }
}

std::vector<std::size_t> all_of(const OrientedCloud& cloud) {
  std::vector<std::size_t> indices(cloud.points.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

double distance_to_segment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  return closest_points(point, point, a, b).distance;
}

TEST(FitCylinders, FindsOneWithItsAxisAndItsEnds) {
  Rng rng(1);
  OrientedCloud cloud;
  const Vector3d a(-0.05, 0.02, 0.03);
  const Vector3d b(0.06, -0.01, 0.05);
  add_half_cylinder(cloud, a, b, 2000, rng);
  const FitSettings settings;
  const std::vector<Cylinder> cylinders = fit_cylinders(cloud, all_of(cloud), radius, settings);
  ASSERT_EQ(cylinders.size(), 1U);
  const Cylinder& cylinder = cylinders.front();
  EXPECT_EQ(cylinder.points.size(), 2000U);
  for (const Vector3d& end : cylinder.ends) EXPECT_LT(distance_to_segment(end, a, b), 1e-4);
  EXPECT_NEAR((cylinder.ends[1] - cylinder.ends[0]).norm(), (b - a).norm() - 2 * settings.trim, 1e-3);
}

TEST(FitCylinders, FindsBothArmsOfABend) {
  Rng rng(2);
  OrientedCloud cloud;
  const Vector3d a(-0.1, 0, 0.03);
  const Vector3d bend(0, 0, 0.03);
  const Vector3d b(0.08, 0.06, 0.03);
  add_half_cylinder(cloud, a, bend, 2000, rng);
  add_half_cylinder(cloud, bend, b, 2000, rng);
  const std::vector<Cylinder> cylinders = fit_cylinders(cloud, all_of(cloud), radius, {});
  ASSERT_EQ(cylinders.size(), 2U);
  for (const Cylinder& cylinder : cylinders) {
    for (const Vector3d& end : cylinder.ends) {
      EXPECT_LT(std::min(distance_to_segment(end, a, bend), distance_to_segment(end, bend, b)), 1e-3);
    }
  }
  const auto first_arm = [&](const Cylinder& cylinder) {
    return cylinder.ends[0].x() < -0.02 || cylinder.ends[1].x() < -0.02;
  };
  EXPECT_NE(first_arm(cylinders[0]), first_arm(cylinders[1]));
}

TEST(FitCylinders, TakesTwoPiecesOnOneAxisForTwo) {
  Rng rng(3);
  OrientedCloud cloud;
  add_half_cylinder(cloud, {-0.1, 0, 0.03}, {-0.02, 0, 0.03}, 1500, rng);
  add_half_cylinder(cloud, {0.04, 0, 0.03}, {0.1, 0, 0.03}, 1000, rng);
  const std::vector<Cylinder> cylinders = fit_cylinders(cloud, all_of(cloud), radius, {});
  ASSERT_EQ(cylinders.size(), 2U);
  EXPECT_EQ(cylinders[0].points.size(), 1500U);
  EXPECT_EQ(cylinders[1].points.size(), 1000U);
}

TEST(FitCylinders, GivesNoPointToTwoCylinders) {
  Rng rng(4);
  OrientedCloud cloud;
  add_half_cylinder(cloud, {-0.1, 0, 0.03}, {0, 0, 0.03}, 800, rng);
  add_half_cylinder(cloud, {0, 0, 0.03}, {0.08, 0.03, 0.04}, 800, rng);
  std::vector<int> times(cloud.points.size());
  for (const Cylinder& cylinder : fit_cylinders(cloud, all_of(cloud), radius, {})) {
    EXPECT_TRUE(std::ranges::is_sorted(cylinder.points));
    for (const std::size_t point : cylinder.points) ++times[point];
  }
  EXPECT_EQ(*std::ranges::max_element(times), 1);
}

TEST(FitCylinders, FindsNoneOnAPlaneNorAmongPointsAtOnePlace) {
  OrientedCloud plane;
  for (int i = 0; i < 400; ++i) {
    plane.points.emplace_back(0.005F * static_cast<float>(i % 20), 0.005F * static_cast<float>(i / 20), 0.1F);
    plane.normals.emplace_back(Eigen::Vector3f::UnitZ());
    plane.curvatures.push_back(0);
  }
  EXPECT_TRUE(fit_cylinders(plane, all_of(plane), radius, {}).empty());
  OrientedCloud place = plane;
  std::ranges::fill(place.points, Eigen::Vector3f(0, 0, 0.1F));
  EXPECT_TRUE(fit_cylinders(place, all_of(place), radius, {}).empty());
  EXPECT_TRUE(fit_cylinders({}, {}, radius, {}).empty());
}

TEST(FitCylinders, LeavesAloneWhatIsOfAnotherRadius) {
  Rng rng(5);
  OrientedCloud cloud;
  add_half_cylinder(cloud, {-0.1, 0, 0.03}, {0, 0, 0.03}, 1000, rng);
  EXPECT_TRUE(fit_cylinders(cloud, all_of(cloud), 2 * radius, {}).empty());
}

}  // namespace
}  // namespace tanglebin
