#include "tanglebin/cloud/images.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/cloud/clouds.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(CloudFromDepths, HasAPointForEachPixelAtItsDepth) {
  const Intrinsics camera{.width = 3, .height = 2, .fx = 2, .fy = 4, .cx = 1, .cy = 0.5};
  const PointCloud cloud = cloud_from_depths({3, 2, {1, 2, nan, 0.5F, 3, 4}}, camera);
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.height, 2U);
  ASSERT_EQ(cloud.points.size(), 6U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(-0.5F, -0.125F, 1));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(0, -0.25F, 2));
  EXPECT_TRUE(same_point(cloud.points[2], Eigen::Vector3f::Constant(nan)));
  EXPECT_EQ(cloud.points[5], Eigen::Vector3f(2, 0.5F, 4));
}

TEST(CloudFromDepths, ADepthThatIsNotPositiveIsNoMeasurement) {
  const Intrinsics camera{.width = 2, .height = 2, .fx = 2, .fy = 2, .cx = 0.5, .cy = 0.5};
  const float infinity = std::numeric_limits<float>::infinity();
  const PointCloud cloud = cloud_from_depths({2, 2, {0, -1, infinity, 1}}, camera);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(same_point(cloud.points[i], Eigen::Vector3f::Constant(nan))) << i;
  EXPECT_EQ(cloud.points[3].z(), 1);
}

TEST(CloudFromDepths, APointIsSeenWhereItsPixelIs) {
  const Intrinsics intrinsics{.width = 40, .height = 30, .fx = 35, .fy = 36, .cx = 20.5, .cy = 14};
  const Camera camera = camera_with(intrinsics, Eigen::Isometry3d::Identity());
  const PointCloud cloud = cloud_from_depths({40, 30, std::vector<float>(1200, 1.7F)}, intrinsics);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto pixel = pixel_of(camera, cloud.points[i].cast<double>());
    ASSERT_TRUE(pixel);
    ASSERT_EQ(static_cast<std::size_t>(pixel->row) * 40 + static_cast<std::size_t>(pixel->column), i);
  }
}

TEST(CloudFromDepths, AnImageOfAnotherSizeIsNotThisCameras) {
  const Intrinsics camera{.width = 3, .height = 2, .fx = 2, .fy = 4, .cx = 1, .cy = 0.5};
  EXPECT_EQ(complaint([&] {
              cloud_from_depths({1, 2, {1, 2}}, camera);
            }),
            "size: found 1 x 2 pixels, expected 3 x 2, the size of the camera's image");
  EXPECT_EQ(
      complaint([&] {
        cloud_from_depths({2, 3, std::vector<float>(6)}, camera);
      }),
      "size: found 2 x 3 pixels, expected 3 x 2, the size of the camera's image; is this one transposed?");
}

}  // namespace
}  // namespace tanglebin
