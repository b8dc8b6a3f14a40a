#include "tanglebin/model/scene/segment_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

using testing::HasSubstr;

// Set C: two junctions, 1 and 2, and ends, 3 to 6.
const SegmentTree set_c = {{1, 2, 0.3}, {1, 3, 0.1}, {1, 4, 0.1}, {2, 5, 0.1}, {2, 6, 0.15}};

std::string complaint_about(const SegmentTree& tree) {
  try {
    validate(tree, "tree");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(SegmentTree, IsOfSegmentsThatMakeATree) {
  EXPECT_EQ(complaint_about(set_c), "");
  EXPECT_THAT(complaint_about({}), HasSubstr("tree: found none, expected at least one segment"));
  EXPECT_THAT(complaint_about({{1, 2, 0.1}, {3, 4, 0.1}}),
              HasSubstr("found a segment from node 3, expected one"));
  EXPECT_THAT(complaint_about({{1, 2, 0.1}, {2, 1, 0.1}}), HasSubstr("node 1, which closes a loop"));
  SegmentTree star;
  for (int end = 2; end < 15; ++end) star.push_back({1, end, 0.1});
  EXPECT_THAT(complaint_about(star), HasSubstr("found more segments at node 1, expected at most 12"));
  for (const double none : {0.0, -0.1, std::numeric_limits<double>::infinity()})
    EXPECT_THAT(complaint_about({{1, 2, none}}), HasSubstr("m from node 1 to 2, expected a positive number"));
}

TEST(SegmentTree, HasALengthAndEnds) {
  EXPECT_NEAR(total_length(set_c), 0.75, 1e-12);
  EXPECT_EQ(count_ends(set_c), 4);
  EXPECT_EQ(count_ends({{1, 2, 0.5}}), 2);
}

TEST(Misfit, IsNoneOfWhatIsSeenOfTheKnownTree) {
  EXPECT_NEAR(misfit(set_c, set_c), 0, 1e-12);
  // By other names, in another order.
  EXPECT_NEAR(misfit({{7, 5, 0.15}, {3, 5, 0.3}, {3, 0, 0.1}, {8, 3, 0.1}, {5, 9, 0.1}}, set_c), 0, 1e-12);
  // Arms, and a junction, are hidden.
  EXPECT_NEAR(misfit({{1, 2, 0.25}, {1, 3, 0.05}, {1, 4, 0.1}}, set_c), 0, 1e-12);
  EXPECT_NEAR(misfit({{1, 2, 0.45}, {1, 3, 0.1}, {1, 4, 0.1}}, set_c), 0, 1e-12);
  EXPECT_NEAR(misfit({{1, 2, 0.55}}, set_c), 0, 1e-12);
}

TEST(Misfit, IsWhatIsTooLong) {
  EXPECT_NEAR(misfit({{1, 2, 0.6}}, set_c), 0.05, 1e-12);
  // The far way leads to the longer arm, past a junction that is not seen.
  EXPECT_NEAR(misfit({{1, 2, 0.47}, {1, 3, 0.1}, {1, 4, 0.1}}, set_c), 0.02, 1e-12);
  EXPECT_NEAR(misfit({{1, 2, 0.3}, {1, 3, 0.1}, {1, 4, 0.1}, {2, 5, 0.12}, {2, 6, 0.15}}, set_c), 0.02,
              1e-12);
}

TEST(Misfit, IsTheLeastOfAllWaysAround) {
  SegmentTree known;
  SegmentTree seen;
  for (int i = 1; i <= 12; ++i) {
    known.push_back({0, i, 0.01 * i});
    seen.push_back({0, i, 0.01 * (13 - i) + 0.001});
  }
  EXPECT_NEAR(misfit(seen, known), 0.012, 1e-12);
}

// A comb of twenty teeth, seen with all of them a little too long.
TEST(Misfit, IsFoundForTreesOfManyJunctions) {
  SegmentTree known;
  SegmentTree seen;
  for (int i = 0; i < 20; ++i) {
    known.push_back({i, i + 1, 0.1});
    known.push_back({i, 100 + i, 0.05});
    seen.push_back({i, i + 1, 0.1});
    seen.push_back({i, 100 + i, 0.051});
  }
  EXPECT_NEAR(misfit(seen, known), 0.02, 1e-9);
}

TEST(Misfit, IsHowFarJunctionsAreFromTheirDistance) {
  for (const double distance : {0.27, 0.33}) {
    const SegmentTree seen = {{1, 2, distance}, {1, 3, 0.1}, {1, 4, 0.1}, {2, 5, 0.1}, {2, 6, 0.1}};
    EXPECT_NEAR(misfit(seen, set_c), 0.03, 1e-12);
  }
}

TEST(Misfit, IsTheLengthOfABranchThatTheTreeHasNot) {
  // In the middle of an arm, at a junction, and on a chain.
  SegmentTree seen = {{1, 2, 0.3}, {1, 3, 0.1}, {1, 4, 0.1}, {2, 5, 0.1}, {2, 7, 0.08}, {7, 6, 0.07}};
  seen.push_back({7, 8, 0.02});
  EXPECT_NEAR(misfit(seen, set_c), 0.02, 1e-12);
  seen = set_c;
  seen.push_back({1, 7, 0.03});
  EXPECT_NEAR(misfit(seen, set_c), 0.03, 1e-12);
  EXPECT_NEAR(misfit({{1, 2, 0.2}, {2, 3, 0.2}, {2, 4, 0.04}}, {{1, 2, 0.5}}), 0.04, 1e-12);
}

// A tree of up to seven segments with lengths from 1 cm to 30 cm.
SegmentTree any_tree() {
  SegmentTree tree;
  const int segments = *rc::gen::inRange(1, 8);
  for (int i = 0; i < segments; ++i) {
    const int from = *rc::gen::inRange(0, i + 1);
    tree.push_back({from, i + 1, 0.01 * *rc::gen::inRange(1, 31)});
  }
  return tree;
}

RC_GTEST_PROP(MisfitOfAnyTree, IsNoneToItselfAndAtMostItsLength, ()) {
  const SegmentTree tree = any_tree();
  const SegmentTree other = any_tree();
  constexpr double rounding = 1e-12;
  RC_ASSERT(misfit(tree, tree) < rounding);
  RC_ASSERT(misfit(tree, other) > -rounding);
  RC_ASSERT(misfit(tree, other) < total_length(tree) + rounding);
}

RC_GTEST_PROP(MisfitOfAnyTree, StaysWhereAnEndIsHidden, ()) {
  const SegmentTree tree = any_tree();
  SegmentTree seen = tree;
  const int last = static_cast<int>(seen.size());
  Segment& end = seen.back();  // no other segment starts where it ends
  RC_ASSERT(end.to == last);
  end.length /= 2;
  RC_ASSERT(misfit(seen, tree) < 1e-12);
}

}  // namespace
}  // namespace tanglebin
