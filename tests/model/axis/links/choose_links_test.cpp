#include "tanglebin/model/axis/links/choose_links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/model/axis/fragments/straight_fragment.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::straight_fragment;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TubeKind chain_of(double length) {
  return {.segments = {{1, 2, length}}};
}

TubeKind tree_of(const SegmentTree& segments) {
  return {.segments = segments};
}

std::vector<Link> chosen_of(const std::vector<Fragment>& fragments, const TubeKind& kind,
                            const RangeImage& seen) {
  const std::vector<Link> links = find_links(fragments, seen, kind, {});
  std::vector<Link> chosen;
  for (const std::size_t i : choose_links(fragments, links, kind, {}, seen).links) chosen.push_back(links[i]);
  return chosen;
}

// Of those that there are where nothing was seen, so that nothing was seen to be empty.
std::vector<Link> chosen_of(const std::vector<Fragment>& fragments, const TubeKind& kind) {
  return chosen_of(fragments, kind, RangeImage({}, camera_preset("paper")));
}

// Two of the three are a tube, but not all of them.
TEST(ChooseLinks, PreferTheStraightWay) {
  const std::vector<Link> chosen = chosen_of(
      {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}), straight_fragment({0, 0, 0.05}, {0.15, 0, 0.05}),
       straight_fragment({0, 0.05, 0.05}, {0, 0.18, 0.05})},
      chain_of(0.36));
  ASSERT_THAT(chosen, SizeIs(1));
  EXPECT_EQ(chosen.front().fragment, 0U);
  EXPECT_EQ(chosen.front().to.fragment, 1U);
}

// Four pieces in a row, of which any two neighbours would join, but three are too long together.
TEST(ChooseLinks, GiveUpTheWeakestWhereTheTubeWouldBecomeTooLong) {
  const std::vector<Link> chosen = chosen_of({straight_fragment({-0.25, 0, 0.05}, {-0.15, 0, 0.05}),
                                              straight_fragment({-0.13, 0, 0.05}, {-0.03, 0, 0.05}),
                                              straight_fragment({0.02, 0, 0.05}, {0.12, 0, 0.05})},
                                             chain_of(0.24));
  ASSERT_THAT(chosen, SizeIs(1));
  EXPECT_NEAR(chosen.front().gap, 0.02, 1e-12);  // not the gap of 5 cm
}

// Four pieces in a row, of which two make a tube: the heaviest link, between the two in the middle, would
// leave the outer ones alone.
TEST(ChooseLinks, AreExchangedForOnesThatAreHeavierTogether) {
  const std::vector<Fragment> row = {straight_fragment({-0.23, 0, 0.05}, {-0.13, 0, 0.05}),
                                     straight_fragment({-0.11, 0, 0.05}, {-0.01, 0, 0.05}),
                                     straight_fragment({0.005, 0, 0.05}, {0.105, 0, 0.05}),
                                     straight_fragment({0.125, 0, 0.05}, {0.225, 0, 0.05})};
  for (const TubeKind& kind : {chain_of(0.24), tree_of({{1, 2, 0.08}, {1, 3, 0.08}, {1, 4, 0.08}})}) {
    const std::vector<Link> chosen = chosen_of(row, kind);
    ASSERT_THAT(chosen, SizeIs(2)) << kind.segments.size();
    for (const Link& link : chosen) EXPECT_NEAR(link.gap, 0.02, 1e-12);
  }
}

// Two pieces that would be a chain of 40 cm, seen from end to end: it is no tube of 80 cm.
TEST(ChooseLinks, MakeNoTubeThatLacksWhatWouldHaveBeenSeen) {
  std::vector<Fragment> pieces = {straight_fragment({-0.15, 0, 0.05}, {-0.05, 0, 0.05}),
                                  straight_fragment({0.11, 0.1, 0.05}, {0.15, 0.19, 0.05})};
  const auto joined = [&](double length, double hidden) {
    pieces[0].ends[0].hidden = pieces[1].ends[1].hidden = hidden;
    pieces[0].ends[1].hidden = pieces[1].ends[0].hidden = 0.4;
    TubeKind kind = chain_of(length);
    kind.length_min = length;
    return !chosen_of(pieces, kind).empty();
  };
  EXPECT_TRUE(joined(0.4, 0));
  EXPECT_TRUE(joined(0.8, 0.3));
  EXPECT_FALSE(joined(0.8, 0));
}

// A tube of 24 cm with a right angle in its middle, in one piece.
Fragment bent_fragment(const Vector3d& corner) {
  Fragment fragment = straight_fragment(corner - Vector3d(0.12, 0, 0), corner + Vector3d(0, 0.12, 0));
  fragment.nodes.clear();
  for (int i = -12; i <= 12; ++i)
    fragment.nodes.push_back(corner + (i < 0 ? Vector3d(0.01 * i, 0, 0) : Vector3d(0, 0.01 * i, 0)));
  fragment.parents = {0};
  for (std::size_t i = 0; i + 1 < fragment.nodes.size(); ++i) fragment.parents.push_back(i);
  fragment.ends = {{0, fragment.nodes.front(), -Vector3d::UnitX()},
                   {fragment.nodes.size() - 1, fragment.nodes.back(), Vector3d::UnitY()}};
  fragment.length = 0.24;
  return fragment;
}

// Two pieces side by side may be a nearly straight tube, but not where all others are bent.
TEST(ChooseLinks, MakeNoTubeThatLooksLikeNoOther) {
  std::vector<Fragment> pieces = {straight_fragment({-0.12, -0.2, 0.05}, {-0.04, -0.2, 0.05}),
                                  straight_fragment({0.04, -0.17, 0.05}, {0.12, -0.17, 0.05})};
  for (Fragment& piece : pieces) {
    for (FragmentEnd& end : piece.ends) end.hidden = 0.4;
  }
  TubeKind kind = chain_of(0.24);
  kind.length_min = 0.24;
  EXPECT_THAT(chosen_of(pieces, kind), SizeIs(1));
  pieces.push_back(bent_fragment({0.3, 0, 0.05}));
  EXPECT_THAT(chosen_of(pieces, kind), SizeIs(1));
  // Two that are bent are enough, if they are very much alike.
  pieces.push_back(bent_fragment({0.3, 0.1, 0.05}));
  EXPECT_THAT(chosen_of(pieces, kind), IsEmpty());
  pieces.push_back(bent_fragment({0.3, 0.2, 0.05}));
  EXPECT_THAT(chosen_of(pieces, kind), IsEmpty());
}

// What is known from before counts where no whole tubes are seen.
TEST(ChooseLinks, MakeNoTubeThatLooksUnlikeThoseThatAreKnown) {
  const std::vector<Fragment> pieces = {straight_fragment({-0.12, -0.2, 0.05}, {-0.04, -0.2, 0.05}),
                                        straight_fragment({0.04, -0.2, 0.05}, {0.12, -0.2, 0.05})};
  TubeKind kind = chain_of(0.24);
  kind.length_min = 0.24;
  const RangeImage nothing_seen({}, camera_preset("paper"));
  const std::vector<Link> links = find_links(pieces, nothing_seen, kind, {});
  const CentrePath bar = bent_fragment({0, 0, 0}).nodes;
  const TubeShapes bars({bar, bar, bar}, kind.radius);
  const ChosenLinks chosen = choose_links(pieces, links, kind, {}, nothing_seen);
  EXPECT_THAT(chosen.links, SizeIs(1));
  EXPECT_FALSE(chosen.shapes.are_known());
  const ChosenLinks among_bars = choose_links(pieces, links, kind, {}, nothing_seen, bars);
  EXPECT_THAT(among_bars.links, IsEmpty());
  EXPECT_TRUE(among_bars.shapes.are_bent());
}

// An arm of a right angle, and what may be a piece of the other arm, or go straight on to a third piece.
TEST(ChooseLinks, OfBentTubesMayTurnSharplyWhereThatIsHidden) {
  const std::vector<Fragment> pieces = {straight_fragment({-0.1, 0, 0.05}, {-0.03, 0, 0.05}),
                                        straight_fragment({0, 0.03, 0.05}, {0, 0.1, 0.05}),
                                        straight_fragment({0, -0.01, 0.05}, {0, 0.01, 0.05})};
  const auto link = [&](std::size_t from, std::size_t end, double weight, double angle) {
    Link result{LinkKind::chain_ends, from, end, {1, 0, 0, pieces[1].ends[0].position}, 0.03,
                {1, 0, 0, angle}};
    result.weight = weight;
    return result;
  };
  std::vector<Link> links = {link(2, 1, 11, 0), link(0, 1, 10, 1.5)};
  TubeKind kind = chain_of(0.24);
  kind.length_min = 0.24;
  const RangeImage nothing_seen({}, camera_preset("paper"));
  const CentrePath bar = bent_fragment({0, 0, 0}).nodes;
  const TubeShapes bars({bar, bar, bar}, kind.radius);
  LinkSettings settings;
  EXPECT_THAT(choose_links(pieces, links, kind, settings, nothing_seen, bars).links, ElementsAre(1));
  settings.bent_angles = 1;
  EXPECT_THAT(choose_links(pieces, links, kind, settings, nothing_seen, bars).links, ElementsAre(0));
  // What is likelier not to be true may be what is left where tubes are bent, but not elsewhere.
  settings = {};
  links = {link(0, 1, -1, 1.5)};
  EXPECT_THAT(choose_links(pieces, links, kind, settings, nothing_seen, bars).links, ElementsAre(0));
  EXPECT_THAT(choose_links(pieces, links, kind, settings, nothing_seen).links, IsEmpty());
}

// A square of the floor, 8 cm wide: above it nothing is in the way.
RangeImage floor_seen_at(const Vector3d& middle) {
  std::vector<Eigen::Vector3f> points;
  for (int i = -80; i <= 80; ++i) {
    for (int j = -80; j <= 80; ++j) points.emplace_back(middle.x() + 0.0005 * i, middle.y() + 0.0005 * j, 0);
  }
  return {points, camera_preset("paper")};
}

// An arm, and two ends that may be of the other one of a right angle. The nearer one would go on where the
// floor is seen, the other one upwards.
TEST(ChooseLinks, MakeNoBentTubeOfWhichTheRestWouldBeSeen) {
  std::vector<Fragment> pieces = {straight_fragment({-0.1, 0, 0.05}, {-0.02, 0, 0.05}),
                                  straight_fragment({0, 0.02, 0.05}, {0, 0.03, 0.05}),
                                  straight_fragment({0, 0, 0.075}, {0, 0, 0.085})};
  for (Fragment& piece : pieces) {
    for (FragmentEnd& end : piece.ends) end.hidden = 0.02;
  }
  for (const double y : {-0.4, -0.3, -0.2}) pieces.push_back(bent_fragment({0.3, y, 0.05}));
  TubeKind kind = chain_of(0.24);
  kind.radius = 0.006;
  kind.length_min = 0.24;
  const auto other_arm = [&](const RangeImage& seen) {
    const std::vector<Link> chosen = chosen_of(pieces, kind, seen);
    return chosen.size() == 1 && chosen.front().fragment == 0 ? chosen.front().to.fragment : 0;
  };
  EXPECT_EQ(other_arm(RangeImage({}, camera_preset("paper"))), 1U);
  EXPECT_EQ(other_arm(floor_seen_at({0, 0.08, 0})), 2U);
}

TEST(ChooseLinks, CloseNoTube) {
  // Four sides of a square: three joins make it an open chain.
  const double s = 0.08;
  const std::vector<Fragment> square = {straight_fragment({-s, -s - 0.02, 0.05}, {s, -s - 0.02, 0.05}),
                                        straight_fragment({s + 0.02, -s, 0.05}, {s + 0.02, s, 0.05}),
                                        straight_fragment({s, s + 0.02, 0.05}, {-s, s + 0.02, 0.05}),
                                        straight_fragment({-s - 0.02, s, 0.05}, {-s - 0.02, -s, 0.05})};
  EXPECT_THAT(chosen_of(square, chain_of(2)), SizeIs(3));
}

// Three arms whose axes meet 3 cm before each of them begins.
TEST(ChooseLinks, OfTreesMeetWhereTheJunctionIsHidden) {
  std::vector<Fragment> arms;
  for (const double angle : {0.0, 2.1, 4.2}) {
    const Vector3d way(std::cos(angle), std::sin(angle), 0);
    arms.push_back(straight_fragment(Vector3d(0, 0, 0.05) + 0.03 * way, Vector3d(0, 0, 0.05) + 0.13 * way));
  }
  const std::vector<Link> chosen = chosen_of(arms, tree_of({{1, 2, 0.13}, {1, 3, 0.13}, {1, 4, 0.13}}));
  ASSERT_THAT(chosen, SizeIs(2));
  const auto is_to_junction = [](const Link& link) { return link.kind == LinkKind::junction; };
  const auto to_junction = std::ranges::find_if(chosen, is_to_junction);
  ASSERT_NE(to_junction, chosen.end());
  EXPECT_EQ(to_junction->to.end, 0U);
  EXPECT_LT((to_junction->to.position - Vector3d(0, 0, 0.05)).norm(), 0.01);
}

// Two pieces of 15 cm that may well be one tree's, but not one's that has short arms alone.
TEST(ChooseLinks, OfTreesFitTheKnownSegments) {
  const std::vector<Fragment> pieces = {straight_fragment({-0.2, 0, 0.05}, {-0.05, 0, 0.05}),
                                        straight_fragment({0, 0.03, 0.05}, {0.15, 0.03, 0.05})};
  EXPECT_THAT(chosen_of(pieces, tree_of({{1, 2, 0.2}, {1, 3, 0.2}, {1, 4, 0.1}, {1, 5, 0.1}})), SizeIs(1));
  SegmentTree star;
  for (int end = 2; end <= 11; ++end) star.push_back({1, end, 0.06});
  EXPECT_THAT(chosen_of(pieces, tree_of(star)), IsEmpty());
}

TEST(ChooseLinks, OfTreesLeadToJunctionsToo) {
  Fragment bar = straight_fragment({-0.1, 0, 0.05}, {0.1, 0, 0.05});
  bar.nodes = {{-0.1, 0, 0.05}, {0, 0, 0.05}, {0.1, 0, 0.05}};
  bar.parents = {0, 0, 1};
  bar.ends[1].node = 2;
  const std::vector<Link> chosen = chosen_of({bar, straight_fragment({0, 0.02, 0.05}, {0, 0.12, 0.05})},
                                             tree_of({{1, 2, 0.1}, {1, 3, 0.1}, {1, 4, 0.12}}));
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
