#include "tanglebin/export/mask.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A mask from a drawing, rows one after the other: # is inside.
Mask mask_of(const std::vector<std::string>& rows) {
  Mask mask{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}};
  std::uint32_t number = 0;
  for (const std::string& row : rows) {
    for (const char pixel : row) {
      if (pixel == '#') mask.pixels.push_back(number);
      ++number;
    }
  }
  return mask;
}

// The pixels whose centres the polygons enclose, each by the even-odd rule: a ray to the left crosses its
// sides an odd number of times.
std::vector<std::uint32_t> filled(const Mask& mask) {
  std::vector<std::uint32_t> inside;
  const std::vector<Polygon> outlines = polygons(mask);
  for (int v = 0; v < mask.height; ++v) {
    for (int u = 0; u < mask.width; ++u) {
      const auto encloses = [&](const Polygon& polygon) {
        int crossings = 0;
        for (std::size_t i = 0; i < polygon.size(); i += 2) {
          const std::size_t next = (i + 2) % polygon.size();
          const auto [low, high] = std::minmax(polygon[i + 1], polygon[next + 1]);
          if (low <= v && v < high && polygon[i] <= u) ++crossings;
        }
        return crossings % 2 == 1;
      };
      if (std::ranges::any_of(outlines, encloses))
        inside.push_back(static_cast<std::uint32_t>(v * mask.width + u));
    }
  }
  return inside;
}

std::vector<std::uint32_t> from_run_lengths(const std::vector<std::uint32_t>& lengths, const Mask& size) {
  std::vector<std::uint32_t> pixels;
  std::uint32_t position = 0;
  for (std::size_t run = 0; run < lengths.size(); ++run) {
    for (std::uint32_t i = 0; i < lengths[run]; ++i, ++position) {
      const auto height = static_cast<std::uint32_t>(size.height);
      const auto width = static_cast<std::uint32_t>(size.width);
      if (run % 2 == 1) pixels.push_back(position % height * width + position / height);
    }
  }
  std::ranges::sort(pixels);
  return pixels;
}

TEST(Mask, RunsGoDownTheColumns) {
  EXPECT_THAT(run_lengths(mask_of({"..#.",  //
                                   ".##."})),
              ElementsAre(3, 3, 2));
  EXPECT_THAT(run_lengths(mask_of({"#.", ".#"})), ElementsAre(0, 1, 2, 1));
  EXPECT_THAT(run_lengths(mask_of({"...", "..."})), ElementsAre(6));
}

// Worked out by hand: 6 is 0b00110, 48 + 6 = '6'; 100 is 0b00011 0b00100, low bits first with a mark: 'T',
// '3'; the fourth number is 1 − 3 = −2, 0b11110: 'N'.
TEST(Mask, RunLengthsAreCompressedAsTheSpecificationSays) {
  EXPECT_EQ(compressed({6}), "6");
  EXPECT_EQ(compressed({100}), "T3");
  EXPECT_EQ(compressed({0, 3, 5, 1}), "035N");
}

TEST(Mask, APixelIsASquare) {
  EXPECT_THAT(polygons(mask_of({"...", "..#"})), ElementsAre(ElementsAre(3, 1, 3, 2, 2, 2, 2, 1)));
  EXPECT_THAT(box_of(mask_of({"...", "..#"})), ElementsAre(2, 1, 1, 1));
  EXPECT_THAT(polygons(mask_of({"..."})), IsEmpty());
}

TEST(Mask, PixelsThatTouchAtACornerAreTwoPolygons) {
  EXPECT_EQ(polygons(mask_of({"#.", ".#"})).size(), 2U);
  EXPECT_EQ(polygons(mask_of({".#", "#."})).size(), 2U);
}

TEST(Mask, ARingIsOnePolygonThatLeavesItsHoleOpen) {
  const Mask ring = mask_of({"#####",  //
                             "#.#.#",  //
                             "#####"});
  EXPECT_EQ(polygons(ring).size(), 1U);
  EXPECT_EQ(filled(ring), ring.pixels);
}

TEST(Mask, AnyMaskComesBackFromItsPolygonsAndItsRuns) {
  rc::check([] {
    const int width = *rc::gen::inRange(1, 12);
    const int height = *rc::gen::inRange(1, 12);
    Mask mask{width, height, {}};
    const auto is_inside = *rc::gen::container<std::vector<bool>>(static_cast<std::size_t>(width * height),
                                                                  rc::gen::arbitrary<bool>());
    for (std::uint32_t i = 0; i < is_inside.size(); ++i) {
      if (is_inside[i]) mask.pixels.push_back(i);
    }
    RC_ASSERT(filled(mask) == mask.pixels);
    RC_ASSERT(from_run_lengths(run_lengths(mask), mask) == mask.pixels);
  });
}

}  // namespace
}  // namespace tanglebin
