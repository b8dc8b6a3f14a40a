#include "tanglebin/model/axis/seen_radius.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

const Vector3d sensor(0, 0, 2);  // m, above the tube

// What the sensor sees of a tube along x of this radius, whose front is where that of the modelled one is.
std::vector<Vector3d> front_of(double radius, double noise) {
  std::mt19937 random(1);
  std::normal_distribution<double> error(0, 1);
  std::vector<Vector3d> points;
  for (double x = -0.24; x < 0.24; x += 0.001) {
    for (double turn = -80; turn <= 80; turn += 5) {
      const double angle = turn * degree;
      points.emplace_back(x, radius * std::sin(angle),
                          2 * test::radius - radius + radius * std::cos(angle) + noise * error(random));
    }
  }
  return points;
}

// By a straight tube that was fitted to fragments with these points.
std::vector<SeenRadius> seen_by_parts(const std::vector<std::vector<Vector3d>>& parts) {
  std::vector<Fragment> fragments(parts.size());
  std::vector<std::size_t> members;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    members.push_back(part);
    for (const Vector3d& point : parts[part]) {
      fragments[part].points.push_back(points.size());
      points.push_back(point.cast<float>());
    }
  }
  return seen_radii(test::straight_tube(1, 0), fragments, members, points, sensor);
}

std::optional<SeenRadius> seen(const std::vector<Vector3d>& points) {
  const std::vector<SeenRadius> found = seen_by_parts({points});
  return found.empty() ? std::nullopt : std::optional(found.front());
}

TEST(SeenRadius, IsThatOfThePointsNotOfTheModelledTube) {
  for (const double radius : {0.004, 0.009, 0.0125, 0.02}) {
    const auto found = seen(front_of(radius, 0));
    ASSERT_TRUE(found) << radius;
    EXPECT_NEAR(found->radius, radius, 0.01 * radius);
    EXPECT_GE(found->pieces, 5U);
  }
}

TEST(SeenRadius, ErrorGrowsWithNoise) {
  const auto noisy = seen(front_of(0.008, 0.0005));
  const auto noisier = seen(front_of(0.008, 0.001));
  ASSERT_TRUE(noisy && noisier);
  EXPECT_NEAR(noisy->radius, 0.008, 4 * noisy->error);
  EXPECT_NEAR(noisier->radius, 0.008, 4 * noisier->error);
  EXPECT_LT(noisy->error, noisier->error);
}

TEST(SeenRadius, IsNotDrawnAsideByAFewPointsOfANeighbour) {
  std::vector<Vector3d> points = front_of(0.008, 0);
  for (double x = -0.24; x < 0.24; x += 0.001) points.emplace_back(x, 0.009, 0.02);
  const auto found = seen(points);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->radius, 0.008, 0.05 * 0.008);
}

// As where a cable was joined to a hose.
TEST(SeenRadius, IsThatOfEachPartToo) {
  std::vector<Vector3d> thin = front_of(0.006, 0);
  std::vector<Vector3d> thick = front_of(0.0125, 0);
  std::erase_if(thin, [](const Vector3d& point) { return point.x() > -0.1; });
  std::erase_if(thick, [](const Vector3d& point) { return point.x() < -0.1; });
  const std::vector<SeenRadius> found = seen_by_parts({thin, thick});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].radius, 0.0125, 0.0002);
  EXPECT_NEAR(found[1].radius, 0.006, 0.0002);
  EXPECT_NEAR(found[2].radius, 0.0125, 0.0002);
}

TEST(SeenRadius, IsNoneWithoutAnArc) {
  EXPECT_FALSE(seen({}));
  std::vector<Vector3d> flat = front_of(0.0125, 0);
  for (Vector3d& point : flat) point.z() = 2 * test::radius;
  EXPECT_FALSE(seen(flat));
}

}  // namespace
}  // namespace tanglebin
