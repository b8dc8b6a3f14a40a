#include "tanglebin/cloud/label_colors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/cloud/clouds.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
// CIELAB of an sRGB colour under D65 (CIE 15; IEC 61966-2-1), in which equal distances look equal.
Eigen::Vector3d lab(const Color& color) {
  Eigen::Vector3d linear;
  for (int i = 0; i < 3; ++i) {
    const double c = color[static_cast<std::size_t>(i)] / 255.0;
    linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  const Eigen::Matrix3d to_xyz{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
  const Eigen::Vector3d white(0.9505, 1.0, 1.089);
  const Eigen::Vector3d ratio = (to_xyz * linear).cwiseQuotient(white);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f(ratio.x());
  const double y = f(ratio.y());
  const double z = f(ratio.z());
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

TEST(LabelColors, AreOneMoreThanTubesAndAllDistinct) {
  for (const int tubes : {0, 1, 20, 1000, 1'000'000}) {
    auto colors = label_colors(tubes);
    EXPECT_EQ(colors.size(), static_cast<std::size_t>(tubes) + 1);
    colors.push_back(null_color);
    std::ranges::sort(colors);
    EXPECT_EQ(std::ranges::adjacent_find(colors), colors.end());
  }
}

TEST(LabelColors, AreTheSameEveryTime) {
  EXPECT_EQ(label_colors(50), label_colors(50));
  // Stored datasets hold these.
  EXPECT_THAT(label_colors(3), testing::ElementsAre(Color{128, 128, 128}, Color{179, 45, 70},
                                                    Color{70, 141, 217}, Color{125, 153, 27}));
}

TEST(LabelColors, KeepGreyForTheBin) {
  const auto colors = label_colors(2000);
  for (std::size_t i = 1; i < colors.size(); ++i) {
    const auto [least, most] = std::ranges::minmax(colors[i]);
    ASSERT_GT(most - least, 60) << "tube " << i;
  }
}

// A difference of about 2.3 is just noticeable.
TEST(LabelColors, OfTwentyTubesAreEasyToTellApart) {
  auto colors = label_colors(20);
  colors.push_back(null_color);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((lab(colors[i]) - lab(colors[j])).norm(), 20.0) << i << " and " << j;
    }
  }
}

TEST(LabelColors, OfNoSuchNumberOfTubesAreRefused) {
  EXPECT_EQ(complaint([] { label_colors(-1); }), "tubes: found -1, expected 0 to 1000000");
  EXPECT_EQ(complaint([] { label_colors(1'000'001); }), "tubes: found 1000001, expected 0 to 1000000");
}

RC_GTEST_PROP(LabelColors, GiveTheLabelsBack, ()) {
  const int tubes = *rc::gen::inRange(0, 300);
  const auto labels = *rc::gen::container<std::vector<std::int32_t>>(rc::gen::inRange(-1, tubes + 1));
  const auto colors_of_labels = label_colors(tubes);
  std::vector<Color> colors;
  for (const std::int32_t label : labels) {
    colors.push_back(label < 0 ? null_color : colors_of_labels[static_cast<std::size_t>(label)]);
  }
  RC_ASSERT(labels_from_colors(colors, tubes, "cloud.ply") == labels);
}

TEST(LabelColors, NameThePointOfAnUnknownColor) {
  const std::vector<Color> colors{label_colors(5)[5], null_color, Color{1, 2, 3}};
  EXPECT_EQ(
      complaint([&] { labels_from_colors(colors, 5, "cloud.ply"); }),
      "cloud.ply: colour of point 3: found (1, 2, 3), expected black or one of the 6 colours of a scene of "
      "5 tubes");
  EXPECT_EQ(complaint([&] { labels_from_colors(colors, 4, "cloud.ply"); }).substr(0, 31),
            "cloud.ply: colour of point 1: f");
}

PointCloud cloud_in(const std::vector<Color>& colors) {
  PointCloud cloud;
  cloud.points.assign(3, {1, 2, 3});
  cloud.colors = colors;
  cloud.intensities = {4, 5, 6};
  cloud.width = 3;
  return cloud;
}

TEST(Labelled, ACloudWithoutColoursShowsItsLabels) {
  const PointCloud cloud = labelled(cloud_in({}), {0, -1, 2});
  EXPECT_THAT(cloud.labels, testing::ElementsAre(0, -1, 2));
  EXPECT_THAT(cloud.colors, testing::ElementsAre(label_colors(2)[0], null_color, label_colors(2)[2]));
  EXPECT_THAT(cloud.intensities, testing::ElementsAre(4, 5, 6));
}

TEST(Labelled, ColoursOfOtherLabelsGiveWay) {
  const PointCloud cloud =
      labelled(cloud_in({label_colors(1000)[999], label_colors(0)[0], null_color}), {1, 1, -1});
  const Color first = label_colors(1)[1];
  EXPECT_THAT(cloud.colors, testing::ElementsAre(first, first, null_color));
}

TEST(Labelled, ACamerasColoursStay) {
  const std::vector<Color> seen{label_colors(5)[5], null_color, Color{128, 128, 127}};
  const PointCloud cloud = labelled(cloud_in(seen), {1, 1, -1});
  EXPECT_EQ(cloud.colors, seen);
  EXPECT_THAT(cloud.labels, testing::ElementsAre(1, 1, -1));
}

TEST(Labelled, LabelsAboveAMillionShareTheColoursOfSmallerOnes) {
  const PointCloud cloud = labelled(cloud_in({}), {1, 2'000'001, std::numeric_limits<std::int32_t>::max()});
  EXPECT_THAT(cloud.labels, testing::ElementsAre(1, 2'000'001, std::numeric_limits<std::int32_t>::max()));
  EXPECT_EQ(cloud.colors.at(1), cloud.colors.at(0));
  EXPECT_EQ(cloud.colors.at(2), label_colors(483'647)[483'647]);
}

TEST(Labelled, NoPointsAreNone) {
  EXPECT_TRUE(labelled(PointCloud{}, {}).colors.empty());
}

}  // namespace
}  // namespace tanglebin
