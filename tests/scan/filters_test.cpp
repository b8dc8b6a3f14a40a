#include "tanglebin/scan/filters.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr float nothing = 0;

// An image of these depths, row by row, where 0 is no measurement. Labels are whole depths.
Scan image_of(int width, const std::vector<float>& depths) {
  const int height = static_cast<int>(depths.size()) / width;
  Scan scan{.camera = downward_camera(width, height, 100, Vector3d(0, 0, 2)),
            .window = {.left = 0, .top = 0, .width = width, .height = height},
            .pixels = {}};
  scan.pixels.assign(depths.size(), empty_pixel());
  scan.snr.assign(depths.size(), 0);
  scan.mixed.assign(depths.size(), 0);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] == nothing) continue;
    scan.pixels[i].depth = depths[i];
    scan.pixels[i].label = static_cast<int>(depths[i]);
    scan.snr[i] = depths[i];
  }
  return scan;
}

std::vector<float> depths_of(const Scan& scan) {
  std::vector<float> depths;
  for (const Pixel& pixel : scan.pixels) depths.push_back(std::isnan(pixel.depth) ? nothing : pixel.depth);
  return depths;
}

TEST(Median, ALonePixelGoesWithItsNeighbours) {
  const Scan filtered = median_filtered(image_of(3, {1, 1, 1, 1, 5, 1, 1, 1, 1}), 3);
  EXPECT_EQ(filtered.at(1, 1).depth, 1.0F);
  EXPECT_EQ(filtered.at(1, 1).label, 1) << "of the surface whose depth it has";
  EXPECT_EQ(filtered.snr[4], 1.0F);
  EXPECT_EQ(filtered.mixed[4], 1) << "its ray met another one";
}

TEST(Median, AStraightEdgeStaysWhereItIs) {
  const Scan image = image_of(6, {1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2});
  const Scan filtered = median_filtered(image, 3);
  for (int u = 1; u < 5; ++u) {
    EXPECT_EQ(filtered.at(u, 1).depth, image.at(u, 1).depth) << u;
    EXPECT_EQ(filtered.mixed[filtered.index(u, 1)], 0) << u;
  }
}

TEST(Median, AHoleInASurfaceIsFilledAndMarked) {
  const Scan filtered = median_filtered(image_of(3, {1, 1, 1, 1, nothing, 1, 1, 1, 1}), 3);
  EXPECT_EQ(filtered.at(1, 1).depth, 1.0F);
  EXPECT_EQ(filtered.at(1, 1).label, 1);
  EXPECT_EQ(filtered.mixed[4], 1);
  EXPECT_EQ(filtered.snr[4], 1.0F);
}

TEST(Median, WhatIsLostCountsAsFar) {
  // Four of nine are lost, so the median is the farthest of the five others.
  EXPECT_EQ(
      median_filtered(image_of(3, {1, 2, 3, nothing, 4, nothing, nothing, nothing, 5}), 3).at(1, 1).depth,
      5.0F);
  const Scan mostly_lost = image_of(3, {1, 2, 3, nothing, 4, nothing, nothing, nothing, nothing});
  EXPECT_TRUE(std::isnan(median_filtered(mostly_lost, 3).at(1, 1).depth));
  EXPECT_EQ(median_filtered(mostly_lost, 3).at(1, 1).label, null_label);
  EXPECT_EQ(median_filtered(mostly_lost, 3).snr[4], 0.0F);
}

TEST(Median, AMixedPixelPassesItsMarkOn) {
  Scan image = image_of(3, {1.1F, 1.2F, 1.3F, 1.4F, 1.9F, 1.5F, 1.6F, 1.7F, 1.8F});
  image.mixed[5] = 1;
  const Scan filtered = median_filtered(image, 3);
  EXPECT_EQ(filtered.at(1, 1).depth, 1.5F);
  EXPECT_EQ(filtered.mixed[4], 1);
}

TEST(Median, PointsStayOnTheirRays) {
  const Scan filtered = median_filtered(image_of(3, {1, 1, 1, 1, 5, 1, 1, 1, 1.5F}), 3);
  const Pixel& pixel = filtered.at(1, 1);
  const Ray ray = ray_through(filtered.camera, 1, 1);
  EXPECT_TRUE(pixel.point.isApprox(
      (ray.origin + static_cast<double>(pixel.range) * ray.direction).cast<float>(), 1e-6F));
  EXPECT_NEAR(depth_of(filtered.camera, pixel.point.cast<double>()), pixel.depth, 1e-6);
}

// Sorting the whole window, with what is lost or outside as infinitely far.
RC_GTEST_PROP(Median, IsTheMiddleOfTheSortedWindow, ()) {
  constexpr int width = 7;
  const auto values = *rc::gen::container<std::vector<int>>(42, rc::gen::inRange(0, 9));
  const std::vector<float> depths(values.begin(), values.end());
  const int size = *rc::gen::element(3, 5);
  const Scan filtered = median_filtered(image_of(width, depths), size);
  const std::vector<float> found = depths_of(filtered);
  const int height = static_cast<int>(depths.size()) / width;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      std::vector<float> window;
      for (int dv = -(size / 2); dv <= size / 2; ++dv) {
        for (int du = -(size / 2); du <= size / 2; ++du) {
          const bool inside = u + du >= 0 && u + du < width && v + dv >= 0 && v + dv < height;
          const float depth = inside ? depths[static_cast<std::size_t>((v + dv) * width + u + du)] : nothing;
          window.push_back(depth == nothing ? std::numeric_limits<float>::infinity() : depth);
        }
      }
      std::ranges::sort(window);
      const float median = window[window.size() / 2];
      RC_ASSERT(found[static_cast<std::size_t>(v * width + u)] == (std::isinf(median) ? nothing : median));
    }
  }
}

TEST(FillGaps, ANarrowGapIsBridgedStraight) {
  Scan scan = image_of(6, {4, nothing, nothing, nothing, 2, 2});
  fill_gaps(scan, 3);
  EXPECT_EQ(depths_of(scan), (std::vector<float>{4, 3.5F, 3, 2.5F, 2, 2}));
  for (int u = 1; u <= 3; ++u) {
    EXPECT_EQ(scan.at(u, 0).label, 2) << "the nearer surface";
    EXPECT_EQ(scan.mixed[scan.index(u, 0)], 1);
    EXPECT_NEAR(depth_of(scan.camera, scan.at(u, 0).point.cast<double>()), scan.at(u, 0).depth, 1e-6);
  }
  EXPECT_EQ(scan.mixed[0], 0);
}

TEST(FillGaps, AWideOneAndOnesAtTheImagesEdgeStay) {
  const std::vector<float> depths{nothing, 4, nothing, nothing, nothing, nothing, 2, nothing};
  Scan scan = image_of(8, depths);
  fill_gaps(scan, 3);
  EXPECT_EQ(depths_of(scan), depths);
}

TEST(FillGaps, NothingIsFilledFromOneRowToTheNext) {
  const std::vector<float> depths{1, 1, nothing, nothing, 1, 1};
  Scan scan = image_of(3, depths);
  fill_gaps(scan, 3);
  EXPECT_EQ(depths_of(scan), depths);
}

}  // namespace
}  // namespace tanglebin
