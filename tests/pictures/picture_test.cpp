#include "tanglebin/pictures/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/scan/scene.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::chain;
using test::complaint;

constexpr View small{.width = 200, .height = 150};
constexpr View from_above{
    .azimuth = -std::numbers::pi / 2, .elevation = std::numbers::pi / 2, .width = 200, .height = 150};

std::vector<Tube> crossing_tubes() {
  return {chain(1, 0.0125, {Vector3d(-0.2, -0.1, 0.0125), Vector3d(0.2, 0.1, 0.0125)}),
          chain(2, 0.0125, {Vector3d(-0.2, 0.1, 0.0375), Vector3d(0.2, -0.1, 0.0375)}),
          chain(3, 0.0125, {Vector3d(-0.2, 0.1, 0.0625), Vector3d(-0.2, -0.1, 0.0625)})};
}

/// The angle between two colours, rad: light changes only their brightness, but for a highlight.
double hue_distance(const Color& a, const Color& b) {
  const Vector3d x(a[0], a[1], a[2]);
  const Vector3d y(b[0], b[1], b[2]);
  return std::atan2(x.cross(y).norm(), x.dot(y));
}

int count_of_hue(const Picture& picture, const Color& color) {
  return static_cast<int>(std::ranges::count_if(
      picture.pixels, [&](const Color& pixel) { return hue_distance(pixel, color) < 0.08; }));
}

int count_of(const Picture& picture, const Color& color) {
  return static_cast<int>(std::ranges::count(picture.pixels, color));
}

const Color& pixel_at(const Picture& picture, int x, int y) {
  return picture.pixels.at(static_cast<std::size_t>(y * picture.width + x));
}

int brightness(const Color& color) {
  return color[0] + color[1] + color[2];
}

PointCloud cloud_of(std::vector<Vector3f> points) {
  PointCloud cloud;
  cloud.width = points.size();
  cloud.points = std::move(points);
  return cloud;
}

/// A square sheet of points 1 m wide, `spacing` apart, at the height z.
std::vector<Vector3f> sheet(float z, float spacing) {
  std::vector<Vector3f> points;
  for (float x = -0.5F; x <= 0.5F; x += spacing) {
    for (float y = -0.5F; y <= 0.5F; y += spacing) points.emplace_back(x, y, z);
  }
  return points;
}

PointCloud scanned_tubes() {
  return cloud_from_scan(scan(crossing_tubes(), Bin{}, camera_preset("paper")), CloudOf::tubes, 3);
}

TEST(PictureOfTubes, HasTheSizeThatIsAskedFor) {
  const Picture picture = picture_of_tubes(crossing_tubes(), Support{}, {.width = 123, .height = 45}, "");
  EXPECT_EQ(picture.width, 123);
  EXPECT_EQ(picture.height, 45);
  EXPECT_EQ(picture.pixels.size(), 123U * 45U);
}

TEST(PictureOfTubes, ShowsEachTubeInItsColour) {
  const Picture picture = picture_of_tubes(crossing_tubes(), Support{}, small, "");
  const auto colors = label_colors(3);
  for (std::size_t label = 1; label <= 3; ++label) {
    EXPECT_GT(count_of_hue(picture, colors[label]), 100) << "tube " << label;
  }
}

TEST(PictureOfTubes, HasBackgroundInItsCornersAndAllAroundTheBin) {
  const Picture picture = picture_of_tubes(crossing_tubes(), Support{}, small, "");
  for (const int x : {0, 199}) {
    for (const int y : {0, 149}) EXPECT_EQ(pixel_at(picture, x, y), background_color);
  }
  for (int x = 0; x < picture.width; ++x) EXPECT_EQ(pixel_at(picture, x, 0), background_color);
  for (int y = 0; y < picture.height; ++y) EXPECT_EQ(pixel_at(picture, 0, y), background_color);
}

TEST(PictureOfTubes, IsTheSameTwice) {
  const auto draw = [] { return picture_of_tubes(crossing_tubes(), Support{}, small, "").pixels; };
  EXPECT_EQ(draw(), draw());
}

TEST(PictureOfTubes, OfNoTubesIsTheEmptyBin) {
  const Picture picture = picture_of_tubes({}, Support{}, small, "");
  const int background = count_of(picture, background_color);
  EXPECT_LT(background, 200 * 150 * 3 / 4);
  EXPECT_GT(background, 200 * 150 / 5);
  const auto is_grey = [](const Color& c) { return std::abs(c[0] - c[2]) < 30; };
  EXPECT_TRUE(std::ranges::all_of(picture.pixels, is_grey));
}

TEST(PictureOfTubes, ANearWallDoesNotHideATube) {
  // Along the wall at −y, which is between it and the viewer.
  const std::vector<Tube> tubes = {
      chain(1, 0.0125, {Vector3d(-0.2, -0.17, 0.0125), Vector3d(0.2, -0.17, 0.0125)})};
  const View from_the_side{.azimuth = -std::numbers::pi / 2, .elevation = 0.2, .width = 200, .height = 150};
  const Picture picture = picture_of_tubes(tubes, Support{}, from_the_side, "");
  const Color tube = label_colors(1)[1];
  const auto looks_like_tube = [&](const Color& c) { return hue_distance(c, tube) < 0.35; };
  EXPECT_GT(std::ranges::count_if(picture.pixels, looks_like_tube), 400);
}

TEST(PictureOfTubes, AFarWallHidesATubeBehindIt) {
  const std::vector<Tube> tubes = {chain(1, 0.0125, {Vector3d(-0.2, 0.25, 0.05), Vector3d(0.2, 0.25, 0.05)})};
  const View from_the_side{.azimuth = -std::numbers::pi / 2, .elevation = 0.1, .width = 200, .height = 150};
  EXPECT_EQ(count_of_hue(picture_of_tubes(tubes, Support{}, from_the_side, ""), label_colors(1)[1]), 0);
}

TEST(PictureOfTubes, ADarkLineAndShadowSetATubeApartFromTheFloor) {
  const std::vector<Tube> tubes = {chain(1, 0.0125, {Vector3d(-0.2, 0, 0.05), Vector3d(0.2, 0, 0.05)})};
  const Picture picture = picture_of_tubes(tubes, Support{}, from_above, "");
  const Picture empty = picture_of_tubes({}, Support{}, from_above, "");
  // Down the middle column, to the row where the tube begins.
  const Color tube = label_colors(1)[1];
  int y = 0;
  while (y < 150 && hue_distance(pixel_at(picture, 100, y), tube) > 0.3) ++y;
  ASSERT_LT(y, 75);
  EXPECT_LT(brightness(pixel_at(picture, 100, y - 2)), brightness(pixel_at(empty, 100, y - 2)) - 30);
  EXPECT_EQ(pixel_at(picture, 100, y - 25), pixel_at(empty, 100, y - 25));
}

TEST(PictureOfTubes, ShowsATubeThatLiesOutsideOfTheBin) {
  const std::vector<Tube> tubes = {chain(1, 0.05, {Vector3d(2, -0.2, 0.5), Vector3d(2, 0.2, 0.5)})};
  EXPECT_GT(count_of_hue(picture_of_tubes(tubes, Support{}, small, ""), label_colors(1)[1]), 50);
}

TEST(PictureOfTubes, RefusesWhatCannotBeDrawn) {
  const auto far = {chain(1, 0.01, {Vector3d(1e200, 0, 0), Vector3d(0, 0, 0)})};
  EXPECT_THAT(complaint([&] { picture_of_tubes(far, Support{}, small, "far.txt"); }),
              testing::HasSubstr("far.txt: x y z: found 1e+200 m"));
  const auto numbered = {chain(2'000'000'000, 0.01, {Vector3d(0, 0, 0), Vector3d(0.1, 0, 0)})};
  EXPECT_EQ(complaint([&] { picture_of_tubes(numbered, Support{}, small, "odd.txt"); }),
            "odd.txt: label: found 2000000000, expected labels up to 100000");
  EXPECT_EQ(complaint([&] { picture_of_tubes({}, Support{}, {.width = 0}, ""); }),
            "width: found 0, expected 1 to 4096 pixels");
}

TEST(PictureOfTubes, DrawsThePublishedConfigurations) {
  const std::filesystem::path file = std::filesystem::path(TANGLEBIN_PUBLISHED) / "A20_1.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const Picture picture = picture_of_tubes(read_configuration(file), {.bin = bin_preset("published")},
                                           {.width = 600, .height = 450}, "");
  const auto colors = label_colors(20);
  for (std::size_t label = 1; label <= 20; ++label) {
    EXPECT_GT(count_of_hue(picture, colors[label]), 10) << "tube " << label;
  }
}

TEST(PictureOfCloud, ShowsEachLabelInItsColour) {
  PointCloud cloud = scanned_tubes();
  cloud.colors.assign(cloud.points.size(), Color{1, 2, 3});
  const Picture picture = picture_of_cloud(cloud, small, "");
  EXPECT_EQ(picture.pixels.size(), 200U * 150U);
  const auto colors = label_colors(3);
  for (std::size_t label = 1; label <= 3; ++label) {
    EXPECT_GT(count_of_hue(picture, colors[label]), 100) << "tube " << label;
  }
  EXPECT_EQ(pixel_at(picture, 0, 0), background_color);
}

TEST(PictureOfCloud, IsTheSameTwice) {
  const PointCloud cloud = scanned_tubes();
  EXPECT_EQ(picture_of_cloud(cloud, small, "").pixels, picture_of_cloud(cloud, small, "").pixels);
}

TEST(PictureOfCloud, ShowsNullAsBlack) {
  PointCloud cloud = cloud_of(sheet(0, 0.01F));
  cloud.labels.assign(cloud.points.size(), null_label);
  const auto is_dark = [](const Color& c) { return brightness(c) < 150; };
  EXPECT_GT(std::ranges::count_if(picture_of_cloud(cloud, from_above, "").pixels, is_dark), 10000);
}

TEST(PictureOfCloud, WithoutLabelsHasTheColoursOfItsPoints) {
  PointCloud cloud = cloud_of(sheet(0, 0.01F));
  cloud.colors.assign(cloud.points.size(), Color{200, 60, 20});
  EXPECT_GT(count_of_hue(picture_of_cloud(cloud, from_above, ""), {200, 60, 20}), 10000);
}

TEST(PictureOfCloud, WithNeitherIsColouredByHeight) {
  auto points = sheet(0, 0.01F);
  for (Vector3f& point : points) point.z() = point.x() / 2;
  const Picture picture = picture_of_cloud(cloud_of(std::move(points)), from_above, "");
  const Color low = pixel_at(picture, 45, 75);
  const Color high = pixel_at(picture, 155, 75);
  EXPECT_GT(brightness(high), brightness(low) + 100);
  EXPECT_GT(high[0], high[2]) << "yellow above";
  EXPECT_LT(low[0], low[2]) << "blue below";
}

TEST(PictureOfCloud, ADenseSheetHasNoHoles) {
  for (const float spacing : {0.02F, 0.005F, 0.002F}) {
    PointCloud cloud = cloud_of(sheet(0, spacing));
    cloud.colors.assign(cloud.points.size(), Color{200, 60, 20});
    const Picture picture = picture_of_cloud(cloud, from_above, "");
    for (int y = 40; y < 110; ++y) {
      for (int x = 70; x < 130; ++x) {
        ASSERT_LT(hue_distance(pixel_at(picture, x, y), {200, 60, 20}), 0.1)
            << spacing << ": " << x << ' ' << y;
      }
    }
  }
}

TEST(PictureOfCloud, ANearSheetHidesAFarOne) {
  PointCloud cloud = cloud_of(sheet(0, 0.01F));
  const auto below = sheet(-0.3F, 0.01F);
  cloud.labels.assign(cloud.points.size(), 1);
  cloud.points.insert(cloud.points.end(), below.begin(), below.end());
  cloud.labels.resize(cloud.points.size(), 2);
  cloud.width = cloud.points.size();
  const Picture picture = picture_of_cloud(cloud, from_above, "");
  EXPECT_GT(count_of_hue(picture, label_colors(2)[1]), 10000);
  EXPECT_LT(count_of_hue(picture, label_colors(2)[2]), 100);
}

TEST(PictureOfCloud, SurfacesThatFaceTheLightAreBrighter) {
  // A ridge along y, from above: the light comes over the viewer's left shoulder.
  auto points = sheet(0, 0.005F);
  for (Vector3f& point : points) point.z() = 0.5F - std::abs(point.x());
  PointCloud cloud = cloud_of(std::move(points));
  cloud.colors.assign(cloud.points.size(), Color{100, 100, 100});
  const Picture picture = picture_of_cloud(cloud, from_above, "");
  EXPECT_GT(brightness(pixel_at(picture, 75, 75)), brightness(pixel_at(picture, 125, 75)) + 60);
}

TEST(PictureOfCloud, IsTheSameWhereverTheCloudIs) {
  PointCloud here = scanned_tubes();
  for (Vector3f& point : here.points)
    point = (point * 1024).array().round() / 1024;  // so that 64 m change no bit
  PointCloud there = here;
  for (Vector3f& point : there.points) point += Vector3f(64, -32, 16);
  const Picture first = picture_of_cloud(here, small, "");
  const Picture second = picture_of_cloud(there, small, "");
  int different = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    if (std::abs(brightness(first.pixels[i]) - brightness(second.pixels[i])) > 30) ++different;
  }
  EXPECT_LT(different, 30) << "but for roundings";
}

TEST(PictureOfCloud, LeavesOutPointsThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud = cloud_of(sheet(0, 0.02F));
  const Picture picture = picture_of_cloud(cloud, small, "");
  cloud.points.insert(cloud.points.begin() + 3, Vector3f(nan, nan, nan));
  cloud.width = cloud.points.size();
  EXPECT_EQ(picture_of_cloud(cloud, small, "").pixels, picture.pixels);
}

TEST(PictureOfCloud, OfOnePointIsADot) {
  const Picture picture = picture_of_cloud(cloud_of({Vector3f(3, 4, 5)}), small, "");
  EXPECT_NE(pixel_at(picture, 100, 75), background_color);
  EXPECT_GT(count_of(picture, background_color), 200 * 150 - 200);
  EXPECT_EQ(picture_of_cloud(cloud_of({Vector3f(3, 4, 5)}), {.width = 1, .height = 1}, "").pixels.size(), 1U);
}

TEST(PictureOfCloud, RefusesWhatCannotBeDrawn) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const PointCloud& empty : {PointCloud{}, cloud_of({Vector3f(nan, nan, nan)})}) {
    EXPECT_EQ(complaint([&] { picture_of_cloud(empty, small, "empty.ply"); }),
              "empty.ply: found a cloud without points, expected at least one");
  }
  EXPECT_THAT(complaint([] { picture_of_cloud(cloud_of({Vector3f(0, 3e38F, 0)}), small, "far.ply"); }),
              testing::HasSubstr("far.ply: x y z: found 3e+38 m"));
  PointCloud labelled = cloud_of({Vector3f(0, 0, 0)});
  labelled.labels = {123'456};
  EXPECT_EQ(complaint([&] { picture_of_cloud(labelled, small, "odd.ply"); }),
            "odd.ply: label: found 123456, expected labels up to 100000");
}

}  // namespace
}  // namespace tanglebin
