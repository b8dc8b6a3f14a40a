#include "tanglebin/model/axis/links/join_odds.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/model/axis/fragments/straight_fragment.hpp"

namespace tanglebin {
namespace {

constexpr double any_length = std::numeric_limits<double>::infinity();

// A link from the far end of one fragment to the near end of another.
Link link(std::size_t from, std::size_t to, double weight, const std::vector<Fragment>& fragments) {
  const FragmentEnd& end = fragments[to].ends[0];
  return {LinkKind::chain_ends, from, 1, {to, end.node, 0, end.position}, 0.1, {}, weight};
}

/// Two tubes side by side, each in two pieces: 0 goes on with 2, and 1 with 3.
class JoinOdds : public testing::Test {
protected:
  std::vector<Fragment> fragments_ = {test::straight_fragment({0, 0, 0}, {0.1, 0, 0}),
                                      test::straight_fragment({0, 0.05, 0}, {0.1, 0.05, 0}),
                                      test::straight_fragment({0.2, 0, 0}, {0.3, 0, 0}),
                                      test::straight_fragment({0.2, 0.05, 0}, {0.3, 0.05, 0})};
};

TEST_F(JoinOdds, WithoutAnotherWayTheMarginIsTheWeight) {
  const std::vector<Link> links = {link(0, 2, 9, fragments_), link(1, 3, 5, fragments_)};
  const std::vector<TubeJoin> joins = joins_of(fragments_, links, {0, 1}, any_length);
  ASSERT_EQ(joins.size(), 2U);
  EXPECT_EQ(joins[0].log_odds, 9);
  EXPECT_EQ(joins[0].margin, 9);
  EXPECT_EQ(joins[1].margin, 5);
  EXPECT_EQ(joins[0].from, fragments_[0].ends[1].position);
  EXPECT_EQ(joins[0].to, fragments_[2].ends[0].position);
}

TEST_F(JoinOdds, TheMarginIsWhatCrossingTheTubesWouldLose) {
  const std::vector<Link> links = {link(0, 2, 9, fragments_), link(1, 3, 5, fragments_),
                                   link(0, 3, 4, fragments_), link(1, 2, 7, fragments_)};
  for (const TubeJoin& join : joins_of(fragments_, links, {0, 1}, any_length))
    EXPECT_EQ(join.margin, 9 + 5 - 4 - 7);
}

TEST_F(JoinOdds, ALinkThatDisplacesAnotherLosesThatToo) {
  const std::vector<Link> links = {link(0, 2, 9, fragments_), link(1, 3, 5, fragments_),
                                   link(0, 3, 8, fragments_)};
  const std::vector<TubeJoin> joins = joins_of(fragments_, links, {0, 1}, any_length);
  EXPECT_EQ(joins[0].margin, 9 + 5 - 8);
  EXPECT_EQ(joins[1].margin, 5);
}

TEST_F(JoinOdds, AWayThatMakesATubeTooLongDoesNotCount) {
  fragments_[3] = test::straight_fragment({0.2, 0.05, 0}, {0.6, 0.05, 0});
  const std::vector<Link> links = {link(0, 2, 9, fragments_), link(0, 3, 8, fragments_)};
  EXPECT_EQ(joins_of(fragments_, links, {0}, any_length)[0].margin, 1);
  EXPECT_EQ(joins_of(fragments_, links, {0}, 0.35)[0].margin, 9);
}

TEST_F(JoinOdds, ALinkThatClosesALoopDoesNotCount) {
  std::vector<Link> links = {link(0, 2, 9, fragments_), link(2, 1, 8, fragments_), link(2, 0, 7, fragments_)};
  const std::vector<TubeJoin> joins = joins_of(fragments_, links, {0, 1}, any_length);
  EXPECT_EQ(joins[1].margin, 8);
}

}  // namespace
}  // namespace tanglebin
