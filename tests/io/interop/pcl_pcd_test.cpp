#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "tanglebin/io/pcd.hpp"
#include "tests/support/temporary_directory.hpp"

// The Point Cloud Library reads what write_pcd() writes, and read_pcd() what it writes.
namespace tanglebin {
namespace {

using PclCloud = pcl::PointCloud<pcl::PointXYZRGBL>;

PointCloud organized_cloud() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.width = 3;
  cloud.height = 2;
  cloud.points = {{0.1F, 0.2F, 0.3F}, {nan, nan, nan},    {-1.0F, 2.5F, 1e-8F},
                  {4.0F, 5.0F, 6.0F}, {7.0F, 8.0F, 9.0F}, {nan, nan, nan}};
  cloud.labels = {1, -1, 20, 0, 3, -1};
  cloud.colors = {Color{255, 0, 1},     Color{0, 0, 0},   Color{2, 200, 3},
                  Color{128, 128, 128}, Color{4, 5, 250}, Color{0, 0, 0}};
  cloud.viewpoint = Eigen::Translation3d(0.5, -0.25, 2.0) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  return cloud;
}

void expect_same(const PointCloud& ours, const PclCloud& theirs) {
  ASSERT_EQ(ours.width, theirs.width);
  ASSERT_EQ(ours.height, theirs.height);
  for (std::size_t i = 0; i < ours.points.size(); ++i) {
    const pcl::PointXYZRGBL& point = theirs[i];
    for (const int axis : {0, 1, 2}) {
      const float a = ours.points[i][axis];
      const float b = point.data[axis];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
    }
    EXPECT_EQ(ours.colors[i], (Color{point.r, point.g, point.b})) << i;
    EXPECT_EQ(ours.labels[i], static_cast<std::int32_t>(point.label)) << i;
  }
  ASSERT_TRUE(ours.viewpoint);
  EXPECT_TRUE(theirs.sensor_origin_.head<3>().isApprox(ours.viewpoint->translation().cast<float>()));
  EXPECT_TRUE(theirs.sensor_orientation_.toRotationMatrix().isApprox(ours.viewpoint->linear().cast<float>()));
}

class PclPcd : public testing::Test {
protected:
  test::TemporaryDirectory directory_;
  std::string file_ = directory_ / "cloud.pcd";
};

TEST_F(PclPcd, PclReadsOurs) {
  {
    std::ofstream stream(file_, std::ios::binary);
    write_pcd(stream, organized_cloud());
  }
  PclCloud theirs;
  ASSERT_EQ(pcl::io::loadPCDFile(file_, theirs), 0);
  expect_same(organized_cloud(), theirs);
}

TEST_F(PclPcd, WeReadPcls) {
  {
    std::ofstream stream(file_, std::ios::binary);
    write_pcd(stream, organized_cloud());
  }
  PclCloud theirs;
  pcl::PCLPointCloud2 untyped;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  ASSERT_EQ(pcl::io::loadPCDFile(file_, theirs), 0);
  ASSERT_EQ(pcl::io::loadPCDFile(file_, untyped, origin, orientation), 0);

  pcl::PCDWriter writer;
  // All nine digits that a float has.
  constexpr int precision = 9;
  ASSERT_EQ(writer.writeASCII(file_, theirs, precision), 0);
  expect_same(read_pcd(file_), theirs);
  ASSERT_EQ(writer.writeBinary(file_, theirs), 0);
  expect_same(read_pcd(file_), theirs);
  ASSERT_EQ(writer.writeBinaryCompressed(file_, theirs), 0);
  expect_same(read_pcd(file_), theirs);
  // PCL's other writer keeps our types: rgb as F 4.
  ASSERT_EQ(writer.writeASCII(file_, untyped, origin, orientation, precision), 0);
  expect_same(read_pcd(file_), theirs);
  ASSERT_EQ(writer.writeBinary(file_, untyped, origin, orientation), 0);
  expect_same(read_pcd(file_), theirs);
  ASSERT_EQ(writer.writeBinaryCompressed(file_, untyped, origin, orientation), 0);
  expect_same(read_pcd(file_), theirs);
}

TEST_F(PclPcd, NoPointsGoBothWays) {
  {
    std::ofstream stream(file_, std::ios::binary);
    write_pcd(stream, PointCloud{});
  }
  pcl::PCLPointCloud2 theirs;  // PCL's conversion to typed points makes a reference to the first of none
  ASSERT_EQ(pcl::io::loadPCDFile(file_, theirs), 0);
  EXPECT_EQ(theirs.width * theirs.height, 0U);
  ASSERT_EQ(pcl::PCDWriter().writeBinaryCompressed(file_, pcl::PointCloud<pcl::PointXYZ>()), 0);
  EXPECT_TRUE(read_pcd(file_).points.empty());
}

}  // namespace
}  // namespace tanglebin
