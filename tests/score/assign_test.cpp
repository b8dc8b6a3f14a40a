#include "tanglebin/score/assign.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "tanglebin/base/random.hpp"
#include "tests/score/confusions.hpp"

namespace tanglebin {
namespace {

/// The assigned points; fails the test where a segment stands for two tubes, or for one it does not overlap.
std::int64_t assigned_points(const Confusion& confusion, const Assignment& assignment) {
  std::set<std::size_t> tubes_left;
  std::set<std::size_t> used;
  for (std::size_t tube = 0; tube < assignment.size(); ++tube) {
    if (!assignment[tube]) continue;
    tubes_left.insert(tube);
    EXPECT_TRUE(used.insert(*assignment[tube]).second) << "segment " << *assignment[tube] << " twice";
  }
  std::int64_t sum = 0;
  for (const Overlap& overlap : confusion.overlaps) {
    if (assignment[overlap.tube] != overlap.segment) continue;
    sum += overlap.points;
    tubes_left.erase(overlap.tube);
  }
  EXPECT_TRUE(tubes_left.empty()) << "tube " << *tubes_left.begin() << " has a segment it does not overlap";
  return sum;
}

/// The most points of all assignments of the tubes from `row` on, tried one by one.
std::int64_t brute_force(const Counts& counts, std::vector<bool>& used, std::size_t row = 0) {
  if (row == counts.size()) return 0;
  std::int64_t best = brute_force(counts, used, row + 1);
  for (std::size_t column = 0; column < used.size(); ++column) {
    if (used[column]) continue;
    used[column] = true;
    best = std::max(best, counts[row][column] + brute_force(counts, used, row + 1));
    used[column] = false;
  }
  return best;
}

/// Whether an assignment is not the best: it is so exactly where its residual graph has a cycle that gains
/// points (Ahuja, Magnanti, Orlin 1993, Theorem 9.1), which the search for longest paths of Bellman and Ford
/// never finishes with. A hub joins the tubes and segments that are left alone.
bool can_be_improved(const Confusion& confusion, const Assignment& assignment) {
  struct Arc {
    std::size_t from, to;
    std::int64_t gain;
  };
  const std::size_t tubes = confusion.tubes.size();
  const std::size_t hub = tubes + confusion.segments.size();
  std::vector<bool> is_used(confusion.segments.size());
  std::vector<Arc> arcs;
  for (std::size_t tube = 0; tube < tubes; ++tube) {
    arcs.push_back(assignment[tube] ? Arc{tube, hub, 0} : Arc{hub, tube, 0});
    if (assignment[tube]) is_used[*assignment[tube]] = true;
  }
  for (std::size_t segment = 0; segment < is_used.size(); ++segment) {
    arcs.push_back(is_used[segment] ? Arc{hub, tubes + segment, 0} : Arc{tubes + segment, hub, 0});
  }
  for (const auto& [tube, segment, points] : confusion.overlaps) {
    arcs.push_back(assignment[tube] == segment ? Arc{tubes + segment, tube, -points}
                                               : Arc{tube, tubes + segment, points});
  }
  std::vector<std::int64_t> longest(hub + 1, 0);
  for (std::size_t round = 0; round <= hub + 1; ++round) {
    bool changed = false;
    for (const auto& [from, to, gain] : arcs) {
      if (longest[from] + gain <= longest[to]) continue;
      longest[to] = longest[from] + gain;
      changed = true;
    }
    if (!changed) return false;
  }
  return true;
}

/// Up to 5 tubes and 5 segments. Few different counts, so that many assignments tie, or up to a cloud's.
Counts any_small_counts(std::size_t& columns) {
  const auto rows = *integer<std::size_t>(0, 6);
  columns = *integer<std::size_t>(0, 6);
  const std::int64_t most = *rc::gen::element<std::int64_t>(2, 10, 2'304'000);
  return *rc::gen::container<Counts>(
      rows, rc::gen::container<std::vector<std::int64_t>>(
                columns, rc::gen::weightedOneOf<std::int64_t>(
                             {{1, rc::gen::just<std::int64_t>(0)}, {2, integer<std::int64_t>(0, most)}})));
}

RC_GTEST_PROP(Assign, IsTheBestOfAllAssignmentsOfSmallCases, ()) {
  for (int i = 0; i < 50; ++i) {  // rapidcheck runs this a hundred times
    std::size_t columns = 0;
    const Counts counts = any_small_counts(columns);
    const Confusion confusion = confusion_of(counts, columns);
    std::vector<bool> used(columns);
    const Assignment assignment = assign(confusion);
    RC_ASSERT(assigned_points(confusion, assignment) == brute_force(counts, used));
    RC_ASSERT(!can_be_improved(confusion, assignment));
  }
}

Confusion large_confusion(std::size_t rows, std::size_t columns, int most, double density) {
  Rng rng(400);
  Counts counts(rows, std::vector<std::int64_t>(columns));
  for (auto& row : counts) {
    for (auto& points : row) {
      if (uniform_real(rng, 0, 1) < density) points = uniform_integer(rng, 1, most);
    }
  }
  return confusion_of(counts, columns);
}

TEST(Assign, IsTheBestFor200TubesAnd400Labels) {
  for (const int most : {3, 100, 10'000'000}) {
    for (const double density : {0.02, 1.0}) {
      const Confusion confusion = large_confusion(200, 400, most, density);
      const Assignment assignment = assign(confusion);
      assigned_points(confusion, assignment);
      EXPECT_FALSE(can_be_improved(confusion, assignment)) << most << ' ' << density;
    }
  }
}

TEST(Assign, TheBestIsNotThatOfTheGreedy) {
  // The largest overlap, 10, costs more than it brings.
  const Confusion confusion = confusion_of({{10, 9}, {9, 0}}, 2);
  EXPECT_TRUE(can_be_improved(confusion, {0, std::nullopt}));
  EXPECT_EQ(assign(confusion), (Assignment{1, 0}));
}

TEST(Assign, LeavesOutTubesWhereThereAreFewerLabels) {
  EXPECT_EQ(assign(confusion_of({{3}, {5}, {4}}, 1)), (Assignment{std::nullopt, 0, std::nullopt}));
}

TEST(Assign, LeavesOutLabelsWhereThereAreMore) {
  EXPECT_EQ(assign(confusion_of({{3, 5, 4}}, 3)), (Assignment{1}));
}

TEST(Assign, GivesNoTubeALabelThatItDoesNotOverlap) {
  EXPECT_EQ(assign(confusion_of({{7, 0}, {4, 0}}, 2)), (Assignment{0, std::nullopt}));
}

TEST(Assign, OfNothingIsNothing) {
  EXPECT_EQ(assign({}), Assignment{});
  EXPECT_EQ(assign(confusion_of({{}, {}}, 0)), Assignment(2));
}

}  // namespace
}  // namespace tanglebin
