#include "tanglebin/pictures/picture_of_scan.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

Tube tube_across() {
  Tube tube{.id = 1,
            .radius = 0.0125,
            .mass = 0.5,
            .nodes = {{1, {-0.2, 0, 0.1}}, {2, {0.2, 0, 0.1}}},
            .edges = {}};
  tube.edges.push_back({0, 1, 1});
  return tube;
}

Color at(const Picture& picture, int x, int y) {
  return picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x)];
}

class PictureOfScan : public testing::Test {
protected:
  const Camera camera_ = downward_camera(240, 150, 170, {0, 0, 2});
  const Scan ideal_ = scan({tube_across()}, Bin{}, camera_);
};

TEST_F(PictureOfScan, OfAnIdealScanHasNoErrorAndTheSamePanelsTwice) {
  const Picture picture = picture_of_scan(ideal_, ideal_, "scan");
  const int width = picture.width / 3;
  const int height = picture.height / 2;
  EXPECT_EQ(width, ideal_.window.width);
  EXPECT_EQ(height, ideal_.window.height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * width; ++x) ASSERT_EQ(at(picture, x, y), at(picture, x, y + height));
  }
  EXPECT_EQ(at(picture, width + width / 2, height / 2), label_colors(1)[1]) << "the tube in the middle";
  EXPECT_EQ(at(picture, 2 * width + width / 2, height + height / 2), (Color{255, 255, 255})) << "no error";
}

TEST_F(PictureOfScan, ShowsWhatIsTooFarRedTooNearBlueAndLostBlack) {
  Scan measured = ideal_;
  const PixelWindow& window = ideal_.window;
  const auto shift = [&](int x, float error) {
    measured.at(window.left + x, window.top + 20).range += error;
  };
  shift(20, 0.004F);
  shift(21, -0.004F);
  measured.at(window.left + 22, window.top + 20) = empty_pixel();
  const Picture picture = picture_of_scan(ideal_, measured, "scan");
  const int left = 2 * window.width;
  const Color red = at(picture, left + 20, window.height + 20);
  const Color blue = at(picture, left + 21, window.height + 20);
  EXPECT_GT(red[0], 2 * red[2]);
  EXPECT_GT(blue[2], 2 * blue[0]);
  EXPECT_EQ(at(picture, left + 22, window.height + 20), (Color{0, 0, 0}));
  EXPECT_EQ(at(picture, 22, window.height + 20), (Color{0, 0, 0}));
}

TEST_F(PictureOfScan, ShowsALineOfPixelsToo) {
  const Scan line = scan({tube_across()}, Bin{}, downward_camera(2000, 1, 2000, {0, 0, 2}));
  ASSERT_GT(line.window.width, 480) << "so that it is scaled down";
  const Picture picture = picture_of_scan(line, line, "scan");
  EXPECT_EQ(picture.height, 2);
  EXPECT_LE(picture.width, 3 * 480);
  EXPECT_EQ(at(picture, picture.width / 2, 0), label_colors(1)[1]) << "the tube in the middle";
}

TEST_F(PictureOfScan, RefusesAScannerThatSeesNothing) {
  const Scan away = scan({}, Bin{}, downward_camera(240, 150, 170, {50, 0, 2}));
  EXPECT_EQ(
      test::complaint([&] { picture_of_scan(away, away, "tubes.txt"); }),
      "tubes.txt: found a scanner that sees nothing of the scene, expected one that looks at the scene");
}

}  // namespace
}  // namespace tanglebin
