#include <gtest/gtest.h>

#include <algorithm>

#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// A bar that leans, so that its upper face is seen.
TEST(PaperMethod, CutsTubesWithFlatEndsWhereTheirPointsEnd) {
  const double radius = 0.006;
  const Vector3d a(-0.1, -0.02, radius);
  const Vector3d b = a + 0.2 * Vector3d(0.9, 0.2, 0.4).normalized();
  const PointCloud cloud = test::seen_by(
      test::near_camera(), {{0, test::wavy_floor(0, 1)}, {1, test::flat_cylinder(a, b, radius)}});
  const KnownScene known = {.support = {.shape = Support::Shape::plane},
                            .camera = test::near_camera(),
                            .kinds = {{.radius = radius, .segments = {{1, 2, 0.2}}, .flat_ends = true}}};
  const Model model = model_tubes(cloud, known, {.method = Method::paper});
  ASSERT_EQ(model.tubes.size(), 1U);
  EXPECT_TRUE(model.tubes[0].flat_ends);
  EXPECT_NEAR(total_length(model.tubes[0]), 0.2, 0.3 * radius);
  EXPECT_EQ(std::ranges::count(model.labels, 1), std::ranges::count(cloud.labels, 1));
}

}  // namespace
}  // namespace tanglebin
