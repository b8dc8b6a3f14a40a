#include "tanglebin/export/extent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tanglebin/io/mesh.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace tanglebin {
namespace {

/// Of points on a tube's surface.
Extent extent_of_points(const std::vector<Eigen::Vector3f>& points) {
  Extent extent;
  for (const Eigen::Vector3f& point : points) {
    extent.box.extend(point.cast<double>());
    for (const Eigen::Vector3f& other : points)
      extent.diameter = std::max(extent.diameter, static_cast<double>((point - other).norm()));
  }
  return extent;
}

TEST(Extent, OfABarIsThatOfACylinder) {
  Tube bar = test::tube_through({{0, 0, 0}, {0.1, 0, 0}});
  bar.radius = 0.03;
  bar.flat_ends = true;
  const Extent extent = extent_of(bar);
  EXPECT_TRUE(extent.box.sizes().isApprox(Eigen::Vector3d(0.1, 0.06, 0.06)));
  EXPECT_NEAR(extent.diameter, std::hypot(0.1, 0.06), 1e-12);
}

TEST(Extent, HoldsTheSurfaceTightly) {
  Tube tube = test::tube_through({{0, 0, 0}, {0.1, 0.02, 0}, {0.15, 0.1, 0.04}, {0.1, 0.2, 0.05}});
  test::add_branch(tube, 2, {{0.25, 0.1, 0.1}});
  for (const bool flat : {false, true}) {
    tube.flat_ends = flat;
    const Extent extent = extent_of(tube);
    const Extent of_mesh = extent_of_points(mesh_of(tube).vertices);  // 32 sides, on the surface
    EXPECT_TRUE(extent.box.sizes().isApprox(of_mesh.box.sizes(), 0.005));
    EXPECT_NEAR(extent.diameter, of_mesh.diameter, 0.0005);
    EXPECT_GE(extent.diameter, of_mesh.diameter - 1e-6);
  }
}

}  // namespace
}  // namespace tanglebin
