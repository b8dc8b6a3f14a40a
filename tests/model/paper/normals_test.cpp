#include "tanglebin/model/paper/normals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tanglebin/scan/scan_output.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::cloud_of;
using test::paper_scene;
using testing::IsEmpty;

constexpr int neighbours = 15;

std::vector<std::size_t> all_of(const PointCloud& cloud) {
  std::vector<std::size_t> indices(cloud.points.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

TEST(Normals, AreThoseOfTheSurfaceAndPointToTheSensor) {
  const std::vector<Tube> tubes = {test::straight_tube(1, 0)};
  const KnownScene scene = paper_scene();
  const Scan view = scan(tubes, scene.support.bin, scene.camera);
  const PointCloud cloud = cloud_from_scan(view, CloudOf::tubes, 1);
  const OrientedCloud oriented =
      with_normals(cloud, all_of(cloud), scene.camera.pose.translation(), neighbours);
  ASSERT_EQ(oriented.normals.size(), cloud.points.size());
  ASSERT_EQ(oriented.curvatures.size(), cloud.points.size());
  std::size_t close = 0;
  for (std::size_t i = 0; i < oriented.points.size(); ++i) {
    const Eigen::Vector3f& point = oriented.points[i];
    const Eigen::Vector3f to_sensor = scene.camera.pose.translation().cast<float>() - point;
    EXPECT_GE(oriented.normals[i].dot(to_sensor), 0);
    const float x = std::clamp(point.x(), -0.25F, 0.25F);
    const Eigen::Vector3f true_normal = (point - Eigen::Vector3f(x, 0, 0.0125F)).normalized();
    if (oriented.normals[i].dot(true_normal) > std::cos(0.1F)) ++close;
  }
  // The rest is at the outline, where all neighbours are on one side.
  EXPECT_GT(static_cast<double>(close), 0.75 * static_cast<double>(oriented.points.size()));
}

TEST(Normals, OfFewerThanThreePointsAreNone) {
  const PointCloud cloud = cloud_of({{0, 0, 0.1F}, {0.01F, 0, 0.1F}});
  EXPECT_THAT(with_normals(cloud, {0, 1}, {0, 0, 2}, neighbours).points, IsEmpty());
  EXPECT_THAT(with_normals(cloud, {}, {0, 0, 2}, neighbours).points, IsEmpty());
}

}  // namespace
}  // namespace tanglebin
