#include "tanglebin/model/paper/segment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tanglebin/model/scene/filter.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

OrientedCloud filtered(const PointCloud& cloud) {
  const KnownScene scene = test::paper_scene();
  return with_normals(cloud, crop(cloud, scene.support, {}).kept, scene.camera.pose.translation(),
                      PaperSettings{}.normal_neighbours);
}

TEST(GrowRegions, GivesEachTubeThatLiesAloneAClusterOfItsOwn) {
  const PointCloud cloud =
      test::scanned({test::straight_tube(1, -0.1), test::straight_tube(2, 0), test::straight_tube(3, 0.1)});
  const OrientedCloud oriented = filtered(cloud);
  const auto clusters = grow_regions(oriented, {});
  ASSERT_EQ(clusters.size(), 3U);
  std::set<std::int32_t> tubes;
  for (const auto& cluster : clusters) {
    std::set<std::int32_t> labels;
    for (const std::size_t i : cluster) labels.insert(cloud.labels[oriented.indices[i]]);
    ASSERT_EQ(labels.size(), 1U);
    tubes.insert(*labels.begin());
  }
  EXPECT_EQ(tubes.size(), 3U);
}

TEST(GrowRegions, PartsTubesThatTouchAlongTheirLength) {
  const PointCloud cloud = test::scanned({test::straight_tube(1, -0.0125), test::straight_tube(2, 0.0125)});
  const OrientedCloud oriented = filtered(cloud);
  const auto clusters = grow_regions(oriented, {});
  ASSERT_GE(clusters.size(), 2U);
  for (const auto& cluster : clusters) {
    const auto of_first = static_cast<std::size_t>(std::ranges::count_if(
        cluster, [&](std::size_t i) { return cloud.labels[oriented.indices[i]] == 1; }));
    // The crease between them is where neighbours' normals are a blend.
    EXPECT_LT(std::min(of_first, cluster.size() - of_first), cluster.size() / 20 + 1);
  }
}

TEST(GrowRegions, PutsNoPointInTwoClustersAndDropsSmallOnes) {
  const PointCloud cloud = test::scanned({test::straight_tube(1, 0)});
  const OrientedCloud oriented = filtered(cloud);
  std::vector<int> times(oriented.points.size());
  RegionSettings settings;
  for (const auto& cluster : grow_regions(oriented, settings)) {
    EXPECT_GE(cluster.size(), static_cast<std::size_t>(settings.points_min));
    for (const std::size_t i : cluster) ++times[i];
  }
  EXPECT_LE(*std::ranges::max_element(times), 1);
  settings.points_min = static_cast<int>(oriented.points.size()) + 1;
  EXPECT_TRUE(grow_regions(oriented, settings).empty());
}

TEST(GrowRegions, OfNothingAreNone) {
  EXPECT_TRUE(grow_regions({}, {}).empty());
}

}  // namespace
}  // namespace tanglebin
