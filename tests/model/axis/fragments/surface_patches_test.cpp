#include "tanglebin/model/axis/fragments/surface_patches.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float reach = 0.005F;  // m

/// What a patch is made from, in double precision.
struct Expected {
  std::size_t neighbours = 0;
  Vector3d mean = Vector3d::Zero();  // m
  Vector3d variances;                // squares of the reach, ascending
  Vector3d normal;
};

// Neighbours are within the reach, and within as many pixels as it is wide.
Expected expected_at(const PixelGrid& grid, std::size_t item) {
  const Vector3d point = grid.point(item).cast<double>();
  const auto pixels = std::lround(grid.pixels_across(reach, grid.point(item)));
  const auto is_in_window = [&](const PixelPosition& pixel) {
    const auto& [column, row] = grid.pixels()[item];
    return std::max(std::abs(pixel.column - column), std::abs(pixel.row - row)) <= pixels;
  };
  Expected expected;
  Matrix3d products = Matrix3d::Zero();
  for (std::size_t other = 0; other < grid.size(); ++other) {
    const Vector3d way = grid.point(other).cast<double>() - point;
    if (way.norm() > reach || !is_in_window(grid.pixels()[other])) continue;
    ++expected.neighbours;
    expected.mean += way;
    products += way * way.transpose();
  }
  const auto count = static_cast<double>(expected.neighbours);
  expected.mean /= count;
  const Matrix3d covariance = products / count - expected.mean * expected.mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance / (reach * reach));
  expected.variances = solver.eigenvalues();
  expected.normal = solver.eigenvectors().col(0);
  return expected;
}

// A bumpy floor with holes, and beside it single points, whose rows are of any length and of which there is
// no multiple of what is worked on at once.
std::vector<Vector3f> bumpy_floor(std::size_t points) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-0.02F, 0.02F);
  std::uniform_real_distribution<float> far(-0.05F, 0.05F);
  std::vector<Vector3f> result;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = place(random);
    const float y = place(random);
    if (x * x + y * y < 0.005F * 0.005F) continue;
    result.emplace_back(x, y, 0.002F * std::sin(200 * x) + 0.02F * place(random));
    if (i % 50 == 0) result.emplace_back(far(random), far(random), 0.0F);
  }
  return result;
}

TEST(SurfacePatches, AreThePrincipalComponentsOfAllNeighbours) {
  PatchSettings settings;
  settings.roughness_max = 1e9;
  for (const std::size_t points : {std::size_t{1}, std::size_t{7}, std::size_t{2001}}) {
    const PixelGrid grid(bumpy_floor(points), test::small_camera());
    const auto patches = surface_patches(grid, {reach, 1}, 0.0125, settings);
    ASSERT_EQ(patches.size(), grid.size());
    std::size_t found = 0;
    for (std::size_t item = 0; item < grid.size(); ++item) {
      const Expected expected = expected_at(grid, item);
      const std::optional<Patch>& patch = patches[item];
      if (expected.neighbours < 5) {
        EXPECT_FALSE(patch);
        continue;
      }
      if (!patch) {
        EXPECT_LT(expected.variances[1], settings.breadth_min + 1e-4);
        continue;
      }
      ++found;
      EXPECT_LT((patch->mean.cast<double>() - expected.mean).norm(), 1e-7);
      EXPECT_NEAR(patch->breadth, expected.variances[1], 1e-3);
      // In the eighth power of the adjugate, the second direction has not quite gone.
      if (expected.variances[0] < 0.3 * expected.variances[1]) {
        EXPECT_GT(std::abs(patch->normal.cast<double>().dot(expected.normal)), 0.999);
        EXPECT_NEAR(patch->roughness, expected.variances[0], 1e-3);
      }
      EXPECT_GT(patch->normal.z(), 0);
    }
    EXPECT_EQ(found > 0, points > 100);
  }
}

// Of a rectangular patch on a plane, all is known.
TEST(SurfacePatches, OfAPlaneAreFlat) {
  std::vector<Vector3f> points;
  for (int x = -10; x <= 10; ++x) {
    for (int y = -10; y <= 10; ++y)
      points.push_back(Vector3d(0.001 * x, 0.001 * y, 0.0005 * x).cast<float>());
  }
  const PixelGrid grid(points, test::small_camera());
  const Vector3f normal = Vector3f(-0.5F, 0, 1).normalized();
  for (const auto& patch : surface_patches(grid, {reach, 1}, 0.0125, {})) {
    ASSERT_TRUE(patch);
    EXPECT_LT((patch->normal - normal).norm(), 1e-3);
    EXPECT_NEAR(patch->roughness, 0, 1e-4);
  }
}

// One of so many points of a plane, so far apart, on rows of a camera that looks straight down on it.
std::vector<Vector3f> plane_of_points(double spacing) {
  std::vector<Vector3f> points;
  for (double x = -0.01; x <= 0.01; x += spacing) {
    for (double y = -0.01; y <= 0.01; y += spacing) points.push_back(Vector3d(x, y, 0).cast<float>());
  }
  return points;
}

// A disc of the reach has π reach² / spacing² points.
TEST(SurfacePatches, LeaveEachDensePointInAsManyPatchesAsAPatchHasPoints) {
  const PatchSettings settings;
  const double radius = 0.0125;
  for (const double spacing : {0.0004, 0.0005, 0.001, 0.002}) {
    const PixelGrid grid(plane_of_points(spacing), test::small_camera());
    const auto [reach_found, stride] = suitable_sampling(grid, radius, settings);
    EXPECT_GE(reach_found, 0.999 * settings.reach_min * radius);
    EXPECT_LE(reach_found, 1.001 * settings.reach_max * radius);
    const double neighbours = std::numbers::pi * std::pow(reach_found / spacing, 2);
    EXPECT_TRUE(stride == 1 || reach_found < 1.001 * settings.reach_min * radius);
    EXPECT_GT(neighbours / static_cast<double>(stride), 0.5 * settings.neighbours);
    EXPECT_EQ(stride > 1, spacing < 0.0006) << spacing;
    PatchSettings of_all = settings;
    of_all.at_every_point = true;
    EXPECT_EQ(suitable_sampling(grid, radius, of_all).stride, 1U);
    EXPECT_EQ(suitable_sampling(grid, radius, of_all).reach, reach_found);
  }
}

TEST(SurfacePatches, OfSomePointsAreThoseThatAllWouldHave) {
  const PixelGrid grid(bumpy_floor(2001), test::small_camera());
  const auto all = surface_patches(grid, {reach, 1}, 0.0125, {.roughness_max = 1e9});
  for (const std::size_t stride : {std::size_t{2}, std::size_t{3}, std::size_t{5000}}) {
    const auto some = surface_patches(grid, {reach, stride}, 0.0125, {.roughness_max = 1e9});
    ASSERT_EQ(some.size(), (grid.size() + stride - 1) / stride);
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto& whole = all[i * stride];
      ASSERT_EQ(some[i].has_value(), whole.has_value());
      if (!whole) continue;
      EXPECT_EQ(some[i]->normal, whole->normal);
      EXPECT_EQ(some[i]->mean, whole->mean);
    }
  }
}

}  // namespace
}  // namespace tanglebin
