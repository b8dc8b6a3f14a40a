#include "tanglebin/model/axis/fragments/kinds.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tanglebin/scan/scan_output.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

constexpr std::array<double, 3> radii = {0.008, 0.0125, 0.018};

KnownScene mixed_scene() {
  KnownScene scene = test::paper_scene();
  scene.kinds.clear();
  for (const double radius : radii) scene.kinds.push_back({.radius = radius});
  return scene;
}

// Tube i is of kind i − 1: beside each other, the thinnest also on the floor under the thickest.
std::vector<Tube> mixed_tubes() {
  const auto [thin, middle, thick] = radii;
  return {test::chain(1, thin, {{-0.2, 0.02, thin}, {0.2, 0.02, thin}}),
          test::chain(2, middle, {{-0.2, 0.1, middle}, {0, 0.12, middle}, {0.2, 0.1, middle}}),
          test::chain(3, thick, {{-0.2, -0.12, thick}, {0.1, 0.06, 0.036}})};
}

// Without the bin's points, as the filter leaves them.
PointCloud mixed_cloud() {
  const KnownScene scene = mixed_scene();
  return cloud_from_scan(scan(mixed_tubes(), scene.support.bin, scene.camera), CloudOf::tubes, 3);
}

TEST(PointsByKind, GoByTheCurvatureOfTheSurface) {
  const PointCloud cloud = mixed_cloud();
  const auto by_kind = points_by_kind(cloud.points, mixed_scene(), {}, {});
  ASSERT_EQ(by_kind.size(), radii.size());
  std::array<int, 3> all{};
  std::array<int, 3> found{};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto kind = static_cast<std::size_t>(cloud.labels[i] - 1);
    ++all[kind];
    for (std::size_t other = 0; other < by_kind.size(); ++other) {
      if (!by_kind[other][i].allFinite()) continue;
      EXPECT_EQ(other, kind) << "point " << i;
      EXPECT_EQ(by_kind[other][i], cloud.points[i]);
      if (other == kind) ++found[kind];
    }
  }
  for (std::size_t kind = 0; kind < radii.size(); ++kind) EXPECT_GT(found[kind], 0.9 * all[kind]) << kind;
}

TEST(PointsByKind, OfASingleKindAreAll) {
  const PointCloud cloud = mixed_cloud();
  const auto by_kind = points_by_kind(cloud.points, test::paper_scene(), {}, {});
  ASSERT_EQ(by_kind.size(), 1U);
  EXPECT_EQ(by_kind[0], cloud.points);
}

TEST(PointsByKind, OfNothingAreNone) {
  for (const auto& points : points_by_kind({}, mixed_scene(), {}, {})) EXPECT_TRUE(points.empty());
}

}  // namespace
}  // namespace tanglebin
