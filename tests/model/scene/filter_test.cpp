#include "tanglebin/model/scene/filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::cloud_of;
using test::paper_scene;
using test::scanned;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Crop, TakesAwayTheWholeBinAndNoTube) {
  // One on the floor, one in the air, one over the rim, with an end that hangs down outside.
  const std::vector<Tube> tubes = {
      test::straight_tube(1, 0), test::chain(2, 0.0125, {{-0.2, 0.1, 0.1}, {0.2, 0.1, 0.15}}),
      test::chain(3, 0.0125, {{0.1, -0.1, 0.2}, {0.29, -0.1, 0.215}, {0.36, -0.1, 0.15}})};
  const PointCloud cloud = scanned(tubes);
  const std::vector<std::size_t> kept = crop(cloud, paper_scene().support, {}).kept;
  std::vector<std::size_t> of_tubes;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] > bin_label) of_tubes.push_back(i);
  }
  EXPECT_EQ(kept, of_tubes);
}

TEST(Crop, OfATubeAtTheWallTakesNoMoreThanItsMargin) {
  const std::vector<Tube> tubes = {
      test::chain(1, 0.0125, {{-0.2, 0.185 - 0.0125, 0.0125}, {0.2, 0.185 - 0.0125, 0.1}})};
  const PointCloud cloud = scanned(tubes);
  const FilterSettings settings;
  const std::vector<std::size_t> kept = crop(cloud, paper_scene().support, settings).kept;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] != 1 || std::ranges::binary_search(kept, i)) continue;
    EXPECT_GE(cloud.points[i].y(), 0.185 - settings.margin);
    ++taken;
  }
  EXPECT_GT(taken, 0U);
}

TEST(Crop, TellsTheBinFromWhatIsNowhereOrFarAway) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PointCloud cloud =
      cloud_of({{0, 0, 0.1F}, {nan, 0, 0.1F}, {5, 0, 0.1F}, {0, 0, -3}, {0, 0, 0.3F}, {0, 0, 0}});
  const Cropped cropped = crop(cloud, paper_scene().support, {});
  EXPECT_THAT(cropped.kept, ElementsAre(0, 4));
  EXPECT_THAT(cropped.support, ElementsAre(5));
  EXPECT_THAT(cropped.outside, ElementsAre(2, 3));
}

TEST(Downsample, DrawsTheShareThatWasAskedForInOrder) {
  std::vector<std::size_t> indices(1001);
  std::iota(indices.begin(), indices.end(), std::size_t{7});
  for (const double ratio : {0.1, 0.3, 0.5, 0.999, 1.0}) {
    const std::vector<std::size_t> drawn = downsample(indices, ratio, 3);
    EXPECT_EQ(drawn.size(), static_cast<std::size_t>(std::llround(ratio * 1001)));
    EXPECT_TRUE(std::ranges::is_sorted(drawn));
    EXPECT_EQ(std::ranges::adjacent_find(drawn), drawn.end());
    EXPECT_TRUE(std::ranges::includes(indices, drawn));
  }
  EXPECT_EQ(downsample(indices, 1.0, 3), indices);
  EXPECT_THAT(downsample({}, 0.5, 3), IsEmpty());
}

TEST(Downsample, FollowsFromTheSeedAndTakesEveryIndexAlike) {
  std::vector<std::size_t> indices(100);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  EXPECT_EQ(downsample(indices, 0.3, 5), downsample(indices, 0.3, 5));
  EXPECT_NE(downsample(indices, 0.3, 5), downsample(indices, 0.3, 6));
  // 4000 draws of 30 out of 100: each index about 1200 times, with a standard deviation of 29.
  std::vector<int> times(100);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const std::size_t index : downsample(indices, 0.3, seed)) ++times[index];
  }
  for (const int count : times) EXPECT_NEAR(count, 1200, 5 * 29);
}

// What a method sees at a ratio is that ratio of the whole cloud, the bin included.
TEST(PointsSeen, AreTheFilteredOnesAndTheSameShareOfTheOthers) {
  const PointCloud cloud = scanned({test::straight_tube(1, 0)});
  const Cropped cropped = crop(cloud, paper_scene().support, {});
  const std::vector<std::size_t> filtered = downsample(cropped.kept, 0.3, 5);
  const auto seen_at = [&](double ratio, const std::vector<std::size_t>& drawn) {
    std::vector<std::size_t> seen;
    for_each_seen(cropped, drawn, ratio, 5, [&](std::size_t i) { seen.push_back(i); });
    return seen;
  };
  const std::vector<std::size_t> seen = seen_at(0.3, filtered);
  ASSERT_GT(seen.size(), filtered.size());
  EXPECT_TRUE(std::equal(filtered.begin(), filtered.end(), seen.begin()));
  const std::size_t all = cropped.kept.size() + cropped.support.size() + cropped.outside.size();
  EXPECT_NEAR(static_cast<double>(seen.size()), 0.3 * static_cast<double>(all), 2);
  EXPECT_EQ(seen_at(1, cropped.kept).size(), all);
}

}  // namespace
}  // namespace tanglebin
