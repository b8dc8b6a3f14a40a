#include "tanglebin/model/links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// A straight piece of a tube, as it would be found.
Fragment fragment(const Vector3d& from, const Vector3d& to) {
  const Vector3d direction = (to - from).normalized();
  return {.points = {},
          .nodes = {from, to},
          .parents = {0, 0},
          .ends = {{0, from, -direction}, {1, to, direction}},
          .length = (to - from).norm()};
}

// Nothing was seen, so that nothing was seen to be empty.
std::vector<Link> links_of(const std::vector<Fragment>& fragments, const TubeKind& kind,
                           const PointCloud& seen = {}) {
  return find_links(fragments, RangeImage(seen, camera_preset("paper")), kind, {});
}

std::vector<Link> chosen_of(const std::vector<Fragment>& fragments, const TubeKind& kind,
                            const PointCloud& seen = {}) {
  const std::vector<Link> links = links_of(fragments, kind, seen);
  std::vector<Link> chosen;
  for (const std::size_t i : choose_links(fragments, links, kind, {})) chosen.push_back(links[i]);
  return chosen;
}

TEST(Links, JoinEndsThatFaceEachOtherAndSayHowFarApartTheyAre) {
  const std::vector<Link> chosen =
      chosen_of({fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}), fragment({0, 0, 0.05}, {0.15, 0, 0.05})}, {});
  ASSERT_THAT(chosen, SizeIs(1));
  const Link& link = chosen.front();
  EXPECT_EQ(link.kind, LinkKind::chain_ends);
  EXPECT_EQ(link.fragment, 0U);
  EXPECT_EQ(link.end, 1U);
  EXPECT_EQ(link.to.fragment, 1U);
  EXPECT_EQ(link.to.end, 0U);
  EXPECT_NEAR(link.gap, 0.05, 1e-12);
  // 1, ln(gap + 2 mm), gap, no angles, and nothing that was seen.
  EXPECT_THAT(link.features, ElementsAre(1, testing::DoubleNear(std::log(0.052), 1e-12),
                                         testing::DoubleNear(0.05, 1e-12), testing::DoubleNear(0, 1e-6),
                                         testing::DoubleNear(0, 1e-6), testing::DoubleNear(0, 1e-6), 0, 0));
}

// Two of the three are a tube, but not all of them.
TEST(Links, PreferTheStraightWay) {
  TubeKind kind;
  kind.length = 0.36;
  const std::vector<Link> chosen =
      chosen_of({fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}), fragment({0, 0, 0.05}, {0.15, 0, 0.05}),
                 fragment({0, 0.05, 0.05}, {0, 0.18, 0.05})},
                kind);
  ASSERT_THAT(chosen, SizeIs(1));
  EXPECT_EQ(chosen.front().fragment, 0U);
  EXPECT_EQ(chosen.front().to.fragment, 1U);
}

TEST(Links, AreNotWhereTheSensorSawThatThereIsNothing) {
  const std::vector<Fragment> fragments = {fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                           fragment({0.05, 0, 0.05}, {0.2, 0, 0.05})};
  EXPECT_THAT(links_of(fragments, {}), testing::Not(IsEmpty()));
  // The empty bin: the sensor saw its floor between the two.
  EXPECT_THAT(links_of(fragments, {}, test::scanned({})), IsEmpty());
}

// A tube lies across the gap. Straight on from both ends the sensor saw first that tube, then the floor.
TEST(Links, KnowHowFarTheirEndsAreOpen) {
  const Tube across = test::chain(1, test::radius, {{0, -0.2, 0.1}, {0, 0.2, 0.1}});
  const std::vector<Link> links =
      links_of({fragment({-0.2, 0, 0.05}, {-0.014, 0, 0.05}), fragment({0.014, 0, 0.05}, {0.2, 0, 0.05})}, {},
               test::scanned({across}));
  const auto is_across = [](const Link& link) { return link.end == 1 && link.to.end == 0; };
  const auto link = std::ranges::find_if(links, is_across);
  ASSERT_NE(link, links.end());
  EXPECT_EQ(link->features[6], 0);
  EXPECT_EQ(link->features[7], 0.5);
}

TEST(Links, MakeNoTubeLongerThanItIs) {
  TubeKind kind;
  const std::vector<Fragment> fragments = {fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                           fragment({0, 0, 0.05}, {0.15, 0, 0.05})};
  kind.length = 0.36;
  EXPECT_THAT(links_of(fragments, kind), testing::Not(IsEmpty()));
  kind.length = 0.33;
  EXPECT_THAT(links_of(fragments, kind), IsEmpty());
}

// Four pieces in a row, of which any two neighbours would join, but three are too long together.
TEST(Links, GiveUpTheWeakestWhereTheTubeWouldBecomeTooLong) {
  TubeKind kind;
  kind.length = 0.24;
  const std::vector<Link> chosen =
      chosen_of({fragment({-0.25, 0, 0.05}, {-0.15, 0, 0.05}), fragment({-0.13, 0, 0.05}, {-0.03, 0, 0.05}),
                 fragment({0.02, 0, 0.05}, {0.12, 0, 0.05})},
                kind);
  ASSERT_THAT(chosen, SizeIs(1));
  EXPECT_NEAR(chosen.front().gap, 0.02, 1e-12);  // not the gap of 5 cm
}

// Four pieces in a row, of which two make a tube: the heaviest link, between the two in the middle, would
// leave the outer ones alone.
TEST(Links, AreExchangedForOnesThatAreHeavierTogether) {
  const std::vector<Fragment> row = {
      fragment({-0.23, 0, 0.05}, {-0.13, 0, 0.05}), fragment({-0.11, 0, 0.05}, {-0.01, 0, 0.05}),
      fragment({0.005, 0, 0.05}, {0.105, 0, 0.05}), fragment({0.125, 0, 0.05}, {0.225, 0, 0.05})};
  for (const int junctions : {0, 1}) {
    const std::vector<Link> chosen = chosen_of(row, {.length = 0.24, .junctions = junctions});
    ASSERT_THAT(chosen, SizeIs(2)) << junctions;
    for (const Link& link : chosen) EXPECT_NEAR(link.gap, 0.02, 1e-12);
  }
}

TEST(Links, CloseNoTube) {
  // Four sides of a square: three joins make it an open chain.
  const double s = 0.08;
  const std::vector<Fragment> square = {fragment({-s, -s - 0.02, 0.05}, {s, -s - 0.02, 0.05}),
                                        fragment({s + 0.02, -s, 0.05}, {s + 0.02, s, 0.05}),
                                        fragment({s, s + 0.02, 0.05}, {-s, s + 0.02, 0.05}),
                                        fragment({-s - 0.02, s, 0.05}, {-s - 0.02, -s, 0.05})};
  TubeKind kind;
  kind.length = 2;
  EXPECT_THAT(chosen_of(square, kind), SizeIs(3));
}

// Three arms whose axes meet 3 cm before each of them begins.
TEST(Links, OfTreesMeetWhereTheJunctionIsHidden) {
  std::vector<Fragment> arms;
  for (const double angle : {0.0, 2.1, 4.2}) {
    const Vector3d way(std::cos(angle), std::sin(angle), 0);
    arms.push_back(fragment(Vector3d(0, 0, 0.05) + 0.03 * way, Vector3d(0, 0, 0.05) + 0.13 * way));
  }
  const std::vector<Link> chosen = chosen_of(arms, {.length = 0.5, .junctions = 1});
  ASSERT_THAT(chosen, SizeIs(2));
  const auto is_to_junction = [](const Link& link) { return link.kind == LinkKind::junction; };
  const auto to_junction = std::ranges::find_if(chosen, is_to_junction);
  ASSERT_NE(to_junction, chosen.end());
  EXPECT_EQ(to_junction->to.end, 0U);
  EXPECT_LT((to_junction->to.position - Vector3d(0, 0, 0.05)).norm(), 0.01);
}

// Two pieces in a row. With the arms that were not seen they would be too long.
TEST(Links, OfTreesLeaveRoomForArmsThatAreHidden) {
  const std::vector<Fragment> row = {fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                     fragment({0, 0, 0.05}, {0.15, 0, 0.05})};
  EXPECT_THAT(chosen_of(row, {.length = 0.36, .junctions = 0}), SizeIs(1));
  EXPECT_THAT(chosen_of(row, {.length = 0.36, .junctions = 2}), IsEmpty());
  EXPECT_THAT(chosen_of(row, {.length = 0.44, .junctions = 2}), SizeIs(1));
}

TEST(Links, OfTreesLeadToJunctionsToo) {
  TubeKind kind;
  kind.junctions = 1;
  Fragment bar = fragment({-0.1, 0, 0.05}, {0.1, 0, 0.05});
  bar.nodes = {{-0.1, 0, 0.05}, {0, 0, 0.05}, {0.1, 0, 0.05}};
  bar.parents = {0, 0, 1};
  bar.ends[1].node = 2;
  const std::vector<Link> chosen = chosen_of({bar, fragment({0, 0.02, 0.05}, {0, 0.12, 0.05})}, kind);
  ASSERT_THAT(chosen, SizeIs(1));
  EXPECT_EQ(chosen.front().kind, LinkKind::junction);
  EXPECT_EQ(chosen.front().fragment, 1U);
  EXPECT_EQ(chosen.front().to.fragment, 0U);
  EXPECT_EQ(chosen.front().to.node, 1U);
  EXPECT_EQ(chosen.front().to.end, std::nullopt);
}

TEST(LinkedFragments, AreGroupedByTheChosenLinks) {
  const std::vector<Link> links = {{LinkKind::chain_ends, 0, 0, {2, 0, 0, {0, 0, 0}}, 0, {}},
                                   {LinkKind::chain_ends, 1, 0, {3, 0, 0, {0, 0, 0}}, 0, {}},
                                   {LinkKind::chain_ends, 2, 0, {3, 0, 0, {0, 0, 0}}, 0, {}}};
  EXPECT_THAT(linked_fragments(4, links, {0, 1}), ElementsAre(ElementsAre(0, 2), ElementsAre(1, 3)));
  EXPECT_THAT(linked_fragments(4, links, {}), SizeIs(4));
}

}  // namespace
}  // namespace tanglebin
