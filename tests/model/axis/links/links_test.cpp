#include "tanglebin/model/axis/links/links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/geometry/example_tubes.hpp"
#include "tests/model/axis/fragments/straight_fragment.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::straight_fragment;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// Nothing was seen, so that nothing was seen to be empty.
std::vector<Link> links_of(const std::vector<Fragment>& fragments, const TubeKind& kind,
                           const PointCloud& seen = {}) {
  return find_links(fragments, RangeImage(seen.points, camera_preset("paper")), kind, {});
}

TEST(Links, JoinEndsThatFaceEachOtherAndSayHowFarApartTheyAre) {
  const std::vector<Link> links = links_of({straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                            straight_fragment({0, 0, 0.05}, {0.15, 0, 0.05})},
                                           {});
  ASSERT_THAT(likely(links), SizeIs(1));
  const Link& link = links.front();
  EXPECT_EQ(link.kind, LinkKind::chain_ends);
  EXPECT_EQ(link.fragment, 0U);
  EXPECT_EQ(link.end, 1U);
  EXPECT_EQ(link.to.fragment, 1U);
  EXPECT_EQ(link.to.end, 0U);
  EXPECT_NEAR(link.gap, 0.05, 1e-12);
  // 1, ln(gap + 0.16), gap in radii, no angles, nothing that was seen, and nothing in the way. Both ends are
  // seen.
  EXPECT_THAT(link.features, ElementsAre(1, testing::DoubleNear(std::log(4.16), 1e-12),
                                         testing::DoubleNear(4, 1e-12), testing::DoubleNear(0, 1e-6),
                                         testing::DoubleNear(0, 1e-6), testing::DoubleNear(0, 1e-6), 0, 0,
                                         testing::DoubleNear(0, 1e-6), testing::DoubleNear(0, 1e-6), 2, 0));
}

// Two pieces in a row, and one beyond a wider gap.
TEST(Links, AreWeighedAgainByOtherWeights) {
  const std::vector<Link> links = links_of(
      {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}), straight_fragment({0, 0, 0.05}, {0.1, 0, 0.05}),
       straight_fragment({0.2, 0, 0.05}, {0.25, 0, 0.05})},
      {});
  ASSERT_THAT(links, SizeIs(testing::Ge(2)));
  const std::vector<Link> same = weighed({links.rbegin(), links.rend()}, {});
  ASSERT_THAT(same, SizeIs(links.size()));
  for (std::size_t i = 0; i < links.size(); ++i) EXPECT_EQ(same[i].weight, links[i].weight);
  LinkSettings near_only;
  near_only.chain_prior = 0;
  near_only.weights.chain_ends = {5, 0, -1};  // above 0 where the gap is less than 5 radii
  for (const Link& link : weighed(links, near_only)) EXPECT_LT(link.gap, 5 * 0.0125);
  EXPECT_THAT(weighed(links, near_only), testing::Not(IsEmpty()));
}

// An end that looks back at the other one: no hose turns so sharply, but a bar may where that is hidden.
TEST(Links, WeighNothingWhereOnlyABentTubeTurnsSoSharply) {
  const std::vector<Fragment> pieces = {straight_fragment({-0.1, 0, 0.05}, {0, 0, 0.05}),
                                        straight_fragment({0.04, 0.05, 0.05}, {-0.06, 0.06, 0.05})};
  LinkSettings settings;
  const RangeImage nothing_seen({}, camera_preset("paper"));
  const auto between_near_ends = [&] {
    std::vector<Link> links = find_links(pieces, nothing_seen, {}, settings);
    std::erase_if(links, [](const Link& link) { return link.end != 1 || link.to.end != 0; });
    return links;
  };
  const std::vector<Link> links = between_near_ends();
  ASSERT_THAT(links, SizeIs(1));
  EXPECT_LE(links.front().weight, 0);
  EXPECT_GT(weight_where_bent(links.front(), settings), 0);
  EXPECT_THAT(likely(links), IsEmpty());
  settings.bent_angles = 1;
  EXPECT_EQ(weight_where_bent(links.front(), settings), links.front().weight);
  EXPECT_THAT(between_near_ends(), IsEmpty());
}

// Pieces like a cloud of noise gives, any two of which may be neighbours. By gaps alone, only the nearest
// ones are looked at.
TEST(Links, AreTheHeaviestWhereThereAreTooManyToLookAt) {
  std::vector<Fragment> pieces;
  for (int x = 0; x < 15; ++x) {
    for (int y = 0; y < 15; ++y) {
      const Eigen::Vector3d middle(0.03 * x, 0.037 * y, 0.05);
      pieces.push_back(straight_fragment(middle, middle + Eigen::Vector3d(0.02, 0, 0)));
    }
  }
  LinkSettings by_gap;
  by_gap.angle_max = 7;  // any turns
  by_gap.chain_prior = 1e6;
  by_gap.weights.chain_ends = {0, 0, -1};
  TubeKind endless;
  endless.segments[0].length = 100;
  const std::vector<Link> links = find_links(pieces, RangeImage({}, camera_preset("paper")), endless, by_gap);
  std::vector<double> gaps;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const FragmentEnd& from : pieces[i].ends) {
        for (const FragmentEnd& to : pieces[j].ends) gaps.push_back((to.position - from.position).norm());
      }
    }
  }
  std::ranges::sort(gaps);
  EXPECT_THAT(gaps, SizeIs(100'800));
  ASSERT_THAT(links, SizeIs(40'000));
  for (std::size_t i = 0; i < links.size(); ++i) ASSERT_NEAR(links[i].gap, gaps[i], 1e-9);
}

TEST(Links, AreNotWhereTheSensorSawThatThereIsNothing) {
  const std::vector<Fragment> fragments = {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                           straight_fragment({0.05, 0, 0.05}, {0.2, 0, 0.05})};
  EXPECT_THAT(links_of(fragments, {}), testing::Not(IsEmpty()));
  // The empty bin: the sensor saw its floor between the two.
  EXPECT_THAT(links_of(fragments, {}, test::scanned({})), IsEmpty());
}

// A fragment that crosses the gap halfway, at different heights.
TEST(Links, KnowWhatIsInTheirWay) {
  const auto obstruction_by = [](double height) {
    const std::vector<Link> links = links_of({straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                              straight_fragment({0.05, 0, 0.05}, {0.2, 0, 0.05}),
                                              straight_fragment({0, 0, height}, {0, 0.1, height})},
                                             {});
    const auto is_across = [](const Link& link) { return link.fragment == 0 && link.to.fragment == 1; };
    const auto link = std::ranges::find_if(links, is_across);
    return link == links.end() ? 1 : link->features[7];
  };
  EXPECT_EQ(obstruction_by(0.05 + 2 * test::radius), 0);
  EXPECT_GT(obstruction_by(0.05 + 1.5 * test::radius), 0);
  EXPECT_GT(obstruction_by(0.05 + test::radius), obstruction_by(0.05 + 1.5 * test::radius));
}

TEST(Links, MakeNoTubeLongerThanItIs) {
  TubeKind kind;
  const std::vector<Fragment> fragments = {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                           straight_fragment({0, 0, 0.05}, {0.15, 0, 0.05})};
  kind.segments[0].length = 0.36;
  EXPECT_THAT(links_of(fragments, kind), testing::Not(IsEmpty()));
  kind.segments[0].length = 0.33;
  EXPECT_THAT(links_of(fragments, kind), IsEmpty());
}

TEST(Links, AreObstructedByTubesOfOtherKinds) {
  const std::vector<Fragment> fragments = {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                           straight_fragment({0.05, 0, 0.05}, {0.2, 0, 0.05})};
  const RangeImage nothing_seen({}, camera_preset("paper"));
  const auto obstruction_by = [&](const std::vector<Ball>& others) {
    const std::vector<Link> links = find_links(fragments, nothing_seen, {}, {}, others);
    return links.empty() ? 1 : links.front().features[7];
  };
  const double thick = 3 * test::radius;
  EXPECT_EQ(obstruction_by({}), 0);
  EXPECT_EQ(obstruction_by({{{0, 0, 0.05 + thick + 1.1 * test::radius}, thick}}), 0);
  EXPECT_GT(obstruction_by({{{0, 0, 0.05 + thick}, thick}}), 0);
}

// The straight way was seen to be empty, and a tube blocks the curved one.
TEST(Links, GoOneWayOnly) {
  const double angle = test::radians(25);
  const auto end = [&](double x) { return Eigen::Vector3d(x, 0, 0.05); };
  const auto start = [&](double x) { return Eigen::Vector3d(x, -0.12 * std::tan(angle), 0.05); };
  const std::vector<Fragment> fragments = {straight_fragment(start(-0.2), end(-0.08)),
                                           straight_fragment(end(0.08), start(0.2))};
  PointCloud floor_between;
  for (float x = -0.03F; x < 0.03F; x += 0.001F) {
    for (float y = -0.006F; y < 0.006F; y += 0.001F) floor_between.points.emplace_back(x, y, 0.0F);
  }
  const std::vector<Ball> on_the_curve = {{{0, 0.25 * 0.16 * std::sin(angle), 0.05}, 0.001}};
  const auto links = [&](const PointCloud& seen, const std::vector<Ball>& others) {
    return find_links(fragments, RangeImage(seen.points, camera_preset("paper")), {}, {}, others);
  };
  const auto is_free = [](const Link& link) { return link.features[6] == 0 && link.features[7] == 0; };
  ASSERT_THAT(links({}, on_the_curve), ElementsAre(testing::Truly(is_free))) << "goes straight";
  ASSERT_THAT(links(floor_between, {}), ElementsAre(testing::Truly(is_free))) << "goes by the curve";
  for (const Link& link : links(floor_between, on_the_curve)) EXPECT_FALSE(is_free(link));
}

}  // namespace
}  // namespace tanglebin
