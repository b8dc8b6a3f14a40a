#include "tanglebin/scan/scan_output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;

Pixel pixel_of(std::int32_t label, float x) {
  Pixel pixel{};
  pixel.label = label;
  pixel.depth = 3;
  pixel.point = label == null_label ? Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN())
                                    : Eigen::Vector3f(x, 2.0F * x, 0.5F);
  return pixel;
}

// An image of 4 x 3 of which a window of 2 x 2 sees something: the bin, tube 2, nothing, tube 1.
Scan small_scan() {
  Scan scan;
  scan.camera.width = 4;
  scan.camera.height = 3;
  scan.camera.pose.translation() << 0.1, 0.2, 2.0;
  scan.window = {.left = 1, .top = 1, .width = 2, .height = 2};
  scan.pixels = {pixel_of(bin_label, 1.0F), pixel_of(2, 2.0F), pixel_of(null_label, 0.0F), pixel_of(1, 4.0F)};
  return scan;
}

TEST(CloudFromScan, HoldsTheTubesInTheOrderOfTheirPixels) {
  const PointCloud cloud = cloud_from_scan(small_scan(), CloudOf::tubes, 2);
  const auto colors = label_colors(2);
  EXPECT_THAT(cloud.labels, ElementsAre(2, 1));
  EXPECT_THAT(cloud.points, ElementsAre(Eigen::Vector3f(2, 4, 0.5), Eigen::Vector3f(4, 8, 0.5)));
  EXPECT_THAT(cloud.colors, ElementsAre(colors[2], colors[1]));
  EXPECT_EQ(cloud.width, 2U);
  EXPECT_EQ(cloud.height, 1U);
  ASSERT_TRUE(cloud.viewpoint);
  EXPECT_EQ(cloud.viewpoint->translation(), Eigen::Vector3d(0.1, 0.2, 2.0));
}

TEST(CloudFromScan, HoldsTheBinWhereAskedFor) {
  const PointCloud cloud = cloud_from_scan(small_scan(), CloudOf::tubes_and_bin, 2);
  EXPECT_THAT(cloud.labels, ElementsAre(0, 2, 1));
  EXPECT_EQ(cloud.colors.front(), label_colors(2).front());
}

TEST(CloudFromScan, KnowsTheColorsOfTubesThatTheCameraDoesNotSee) {
  const PointCloud cloud = cloud_from_scan(small_scan(), CloudOf::tubes, 10);
  EXPECT_EQ(labels_from_colors(cloud.colors, 10, "cloud"), cloud.labels);
}

TEST(CloudFromScan, RefusesALabelBeyondTheTubes) {
  for (const auto& cloud_of : {&cloud_from_scan, &organized_cloud_from_scan}) {
    EXPECT_EQ(test::complaint([&] { cloud_of(small_scan(), CloudOf::tubes, 1, {}); }),
              "tubes: found 1, expected at least 2, the largest label of the scan");
  }
}

TEST(OrganizedCloudFromScan, CoversTheWholeImage) {
  const PointCloud cloud = organized_cloud_from_scan(small_scan(), CloudOf::tubes, 2);
  EXPECT_EQ(cloud.width, 4U);
  EXPECT_EQ(cloud.height, 3U);
  check_cloud(cloud);
  EXPECT_THAT(cloud.labels, ElementsAre(-1, -1, -1, -1,  //
                                        -1, -1, 2, -1,   //
                                        -1, -1, 1, -1));
  EXPECT_EQ(cloud.points[6], Eigen::Vector3f(2, 4, 0.5));
  EXPECT_EQ(cloud.colors[10], label_colors(2)[1]);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != null_label) continue;
    EXPECT_TRUE(cloud.points[i].array().isNaN().all()) << i;
    EXPECT_EQ(cloud.colors[i], null_color) << i;
  }
  ASSERT_TRUE(cloud.viewpoint);
  EXPECT_EQ(cloud.viewpoint->translation(), Eigen::Vector3d(0.1, 0.2, 2.0));
}

TEST(OrganizedCloudFromScan, HoldsTheBinWhereAskedFor) {
  const PointCloud cloud = organized_cloud_from_scan(small_scan(), CloudOf::tubes_and_bin, 2);
  EXPECT_EQ(cloud.labels[5], bin_label);
  EXPECT_EQ(cloud.points[5], Eigen::Vector3f(1, 2, 0.5));
}

Scan scan_of_two_pixels() {
  Scan scan{.camera = downward_camera(3, 1, 100, {0, 0, 1}),
            .window = {.left = 0, .top = 0, .width = 2, .height = 1},
            .pixels = {empty_pixel(), empty_pixel()}};
  scan.pixels[1].label = 1;
  scan.pixels[1].point = {1, 2, 3};
  scan.pixels[1].normal = {0, 0, 1};
  return scan;
}

TEST(ScanImages, CoverTheWholeImage) {
  const DepthImage depths = depth_image(small_scan());
  const LabelImage labels = label_image(small_scan());
  EXPECT_EQ(std::pair(depths.width, depths.height), std::pair(4, 3));
  EXPECT_EQ(std::pair(labels.width, labels.height), std::pair(4, 3));
  EXPECT_THAT(labels.labels, ElementsAre(-1, -1, -1, -1,  //
                                         -1, 0, 2, -1,    //
                                         -1, -1, 1, -1));
  EXPECT_EQ(depths.depths[6], 3);
  EXPECT_TRUE(std::isnan(depths.depths[0]));
}

TEST(CloudFromScan, HasThePropertiesThatAreAskedFor) {
  Scan scan = scan_of_two_pixels();
  const PointProperties all{.normals = true, .intensities = true, .mixed = true};
  EXPECT_TRUE(cloud_from_scan(scan, CloudOf::tubes, 1).normals.empty());
  const PointCloud ideal = cloud_from_scan(scan, CloudOf::tubes, 1, all);
  EXPECT_EQ(ideal.normals, std::vector{Eigen::Vector3f(0, 0, 1)});
  EXPECT_EQ(ideal.intensities, std::vector{1.0F}) << "an ideal scanner's signal-to-noise ratio";
  EXPECT_EQ(ideal.mixed, std::vector<std::uint8_t>{0});

  scan.snr = {0, 0.5F};
  scan.mixed = {0, 1};
  const PointCloud organized = organized_cloud_from_scan(scan, CloudOf::tubes, 1, all);
  EXPECT_NO_THROW(check_cloud(organized));
  EXPECT_EQ(organized.intensities, (std::vector{0.0F, 0.5F, 0.0F}));
  EXPECT_EQ(organized.mixed, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_TRUE(organized.normals[0].hasNaN());
}

}  // namespace
}  // namespace tanglebin
