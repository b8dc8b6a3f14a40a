#include "tanglebin/model/axis/fragments/flat_surfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::radius;

// Half as many pixels across as test::near_camera() has.
Camera coarse_camera() {
  return downward_camera(400, 300, 1000, {0, 0, 1});
}

test::Thing level_floor() {
  return {0, test::wavy_floor(0, 1)};
}

test::Thing tube_at(std::int32_t label, double y, double of_radius = radius) {
  return {label, test::flat_cylinder({-0.15, y, of_radius}, {0.15, y, of_radius}, of_radius)};
}

PointCloud noisy(PointCloud cloud, double sigma) {
  std::mt19937 random(5);
  std::normal_distribution<float> error(0, static_cast<float>(sigma));
  for (Eigen::Vector3f& point : cloud.points) point.z() += error(random);
  return cloud;
}

PointCloud cloud_of_things(const std::vector<test::Thing>& things) {
  return test::seen_by(coarse_camera(), things);
}

/// How many patches the points of a label have, and how many of these are flat.
struct Patches {
  int all = 0;
  int flat = 0;

  double share() const { return static_cast<double>(flat) / all; }
};

std::map<std::int32_t, Patches> patches_of(const PointCloud& cloud) {
  const VoteSettings settings;
  const PixelGrid grid(cloud.points, coarse_camera());
  const PatchSampling sampling = suitable_sampling(grid, radius, settings.patch);
  const std::vector<std::optional<Patch>> patches = surface_patches(grid, sampling, radius, settings.patch);
  const std::vector<bool> flat = are_flat(patches, grid, sampling, radius, settings.flat_min);
  std::map<std::int32_t, Patches> of_label;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i]) continue;
    Patches& its_own = of_label[cloud.labels[grid.indices()[i * sampling.stride]]];
    ++its_own.all;
    its_own.flat += flat[i] ? 1 : 0;
  }
  return of_label;
}

TEST(FlatSurfaces, AreFloorsAndTubesAreNot) {
  const PointCloud cloud = cloud_of_things({level_floor(), tube_at(1, 0), tube_at(2, 0.06)});
  for (const double sigma : {0.0, 0.0003, 0.001}) {
    auto found = patches_of(noisy(cloud, sigma));
    EXPECT_GT(found[0].share(), 0.99) << sigma;
    EXPECT_LT(found[1].share(), 0.01) << sigma;
    EXPECT_LT(found[2].share(), 0.01) << sigma;
  }
}

// The floor between them is too narrow to show that it is flat, but it is in the plane of the rest.
TEST(FlatSurfaces, AreSeenThroughGaps) {
  std::vector<test::Thing> things = {level_floor()};
  for (int i = 0; i < 5; ++i) things.push_back(tube_at(i + 1, 3.2 * radius * (i - 2)));
  auto found = patches_of(noisy(cloud_of_things(things), 0.0005));
  EXPECT_GT(found[0].share(), 0.98);
  for (int i = 1; i <= 5; ++i) EXPECT_LT(found[i].share(), 0.01);
}

// As a bin has it.
TEST(FlatSurfaces, MayBeTheNarrowRimOfAWall) {
  auto found =
      patches_of(noisy(cloud_of_things({{0, test::box({-0.15, 0, 0}, {0.15, 1.6 * radius, 0.1})}}), 0.0005));
  EXPECT_GT(found[0].share(), 0.95);
}

// A tube that stands on a floor shows its end.
TEST(FlatSurfaces, AreNotTheEndsOfTubes) {
  auto found =
      patches_of(cloud_of_things({level_floor(), {1, test::flat_cylinder({0, 0, 0}, {0, 0, 0.1}, radius)}}));
  EXPECT_GT(found[0].share(), 0.99);
  EXPECT_LT(found[1].share(), 0.01);
}

// So that what it shows can be compared with the radius that was told.
TEST(FlatSurfaces, AreNotTubesOfTwiceTheRadius) {
  auto found = patches_of(noisy(cloud_of_things({level_floor(), tube_at(1, 0, 2 * radius)}), 0.0003));
  EXPECT_LT(found[1].share(), 0.01);
}

TEST(FlatSurfaces, NeedMoreThanAFewPlaces) {
  // 2 radii square: 4 x 4 places.
  const auto plate = [](double side) {
    return cloud_of_things({{0, test::box({0, 0, 0}, {side, side, 0.001})}});
  };
  EXPECT_EQ(patches_of(plate(2 * radius))[0].flat, 0);
  EXPECT_GT(patches_of(plate(8 * radius))[0].share(), 0.99);
}

TEST(FlatSurfaces, AreNoneInAnEmptyCloud) {
  EXPECT_THAT(patches_of(PointCloud{}), testing::IsEmpty());
}

}  // namespace
}  // namespace tanglebin
