#include "tanglebin/score/score_tubes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "tanglebin/generate/generate.hpp"
#include "tests/geometry/example_tubes.hpp"
#include "tests/score/integer.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::add_branch;
using test::tube_through;

constexpr double rounding = 1e-12;

// True joins, joins found and joins made.
using Counts = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

Counts joins(const std::vector<Tube>& truth, const std::vector<Tube>& modelled) {
  const TubesScore score = score_tubes(truth, modelled);
  return {score.true_joins, score.joins_found, score.joins_made};
}

// Along x, half a metre long.
const Tube straight = tube_through({{0, 0, 0}, {0.5, 0, 0}});

// A piece of that tube, so far off to the side, from x to x; and several with an edge from each to the next.
Tube along_x(const std::vector<double>& x, double off = 0) {
  std::vector<Vector3d> points;
  for (const double at : x) points.emplace_back(at, off, 0);
  return tube_through(points);
}

TEST(CentreLineError, OfAParallelLineIsHowFarItIsOff) {
  const TubesScore score = score_tubes({straight}, {along_x({0, 0.5}, 0.002)});
  EXPECT_NEAR(*score.centre_line_error, 0.002, rounding);
  EXPECT_NEAR(*score.centre_line_error_p95, 0.002, rounding);
  EXPECT_EQ(score.centre_line_coverage, 1.0);
}

TEST(CentreLineError, IsADistanceToTheNearestTube) {
  const Tube other = along_x({0, 0.5}, 0.05);
  EXPECT_NEAR(*score_tubes({straight, other}, {along_x({0, 0.5}, 0.046)}).centre_line_error, 0.004, rounding);
  // 3 mm beyond the end: for half of these 6 mm, up to 3.
  const TubesScore beyond = score_tubes({straight}, {along_x({0.5, 0.506})});
  EXPECT_NEAR(*beyond.centre_line_error, 0.003, 0.0005 + rounding);
}

TEST(CentreLineError, MostIsInTheMedianAndTheWorstInThe95thPercentile) {
  const std::vector<Tube> modelled = {along_x({0, 0.3}, 0.001), along_x({0.3, 0.45}, -0.004),
                                      along_x({0.45, 0.5}, 0.009)};
  const TubesScore score = score_tubes({straight}, modelled);
  EXPECT_NEAR(*score.centre_line_error, 0.001, rounding);
  EXPECT_NEAR(*score.centre_line_error_p95, 0.009, rounding);
}

TEST(CentreLineError, WeighsLengthAndNotPieces) {
  Tube pieces = along_x({0.3, 0.305, 0.31, 0.315, 0.32, 0.325}, 0.005);
  const TubesScore score = score_tubes({straight}, {along_x({0, 0.25}), std::move(pieces)});
  EXPECT_NEAR(*score.centre_line_error, 0, rounding);
  EXPECT_NEAR(*score.centre_line_error_p95, 0.005, rounding);
}

TEST(CentreLineError, OfNothingIsNone) {
  const Tube only_a_node = tube_through({{0.1, 0, 0}});
  const Tube no_longer_than_a_point = tube_through({{0.1, 0, 0}, {0.1, 0, 0}});
  for (const auto& modelled : {std::vector<Tube>{}, {only_a_node}, {Tube{}}}) {
    const TubesScore score = score_tubes({straight}, modelled);
    EXPECT_FALSE(score.centre_line_error);
    EXPECT_FALSE(score.centre_line_error_p95);
    EXPECT_EQ(score.centre_line_coverage, 0.0);
    EXPECT_EQ(score.true_joins, 0);
    EXPECT_EQ(score.joins_made, 0);
  }
  EXPECT_FALSE(score_tubes({straight}, {no_longer_than_a_point}).centre_line_error);
}

TEST(CentreLineError, OfTubesInMillimetresIsAsLargeAsItIs) {
  const TubesScore score = score_tubes({straight}, {along_x({0, 500})});
  EXPECT_NEAR(*score.centre_line_error, 249.5, 0.6);
}

TEST(CentreLineCoverage, IsTheShareOfTheTrueLengthThatIsModelled) {
  EXPECT_EQ(score_tubes({straight}, {straight}).centre_line_coverage, 1.0);
  // A radius of 12.5 mm farther than the piece.
  EXPECT_NEAR(score_tubes({straight}, {along_x({0, 0.2372})}).centre_line_coverage, 0.5, 0.002);
  EXPECT_NEAR(score_tubes({straight, along_x({0, 0.3}, 1)}, {straight}).centre_line_coverage, 5.0 / 8.0,
              rounding);
}

TEST(CompleteTubes, AreCoveredByOneModelledTubeAndHaveALength) {
  const Tube other = along_x({0, 0.5}, 1);
  const TubesScore score = score_tubes({straight, other}, {along_x({0, 0.49}), along_x({0, 0.4}, 1)});
  EXPECT_EQ(score.complete_tubes, 1);
  EXPECT_NEAR(*score.length_error, 0.02, rounding);
  const TubesScore halves = score_tubes({straight}, {along_x({0, 0.25}), along_x({0.25, 0.5})});
  EXPECT_EQ(halves.complete_tubes, 0);
  EXPECT_FALSE(halves.length_error);
}

TEST(CompleteTubes, HaveTheNearestLengthOfThoseThatCoverThem) {
  const Tube longer = tube_through({{0, 0, 0}, {0.6, 0, 0}});
  EXPECT_NEAR(*score_tubes({straight}, {longer, straight}).length_error, 0, rounding);
  EXPECT_NEAR(*score_tubes({straight}, {straight, longer}).length_error, 0, rounding);
}

TEST(Junctions, AreFoundWithinADiameter) {
  Tube tree = straight;
  add_branch(tree, 0, {{0, 0.1, 0}});
  EXPECT_EQ(score_tubes({tree}, {tree}).true_junctions, 0) << "two pieces that meet are a bend";
  add_branch(tree, 0, {{0, -0.1, 0}});
  for (const auto& [off, found] : {std::pair{0.024, 1}, {0.026, 0}}) {
    Tube moved = tree;
    transform(moved, Eigen::Isometry3d(Eigen::Translation3d(0, 0, off)));
    const TubesScore score = score_tubes({tree}, {moved, straight});
    EXPECT_EQ(score.true_junctions, 1);
    EXPECT_EQ(score.junctions_found, found) << off;
    EXPECT_EQ(score.junctions_made, 1);
  }
}

TEST(CentreLineCoverage, EndsARadiusAway) {
  EXPECT_EQ(score_tubes({straight}, {along_x({0, 0.5}, 0.0124)}).centre_line_coverage, 1.0);
  EXPECT_EQ(score_tubes({straight}, {along_x({0, 0.5}, 0.0126)}).centre_line_coverage, 0.0);
}

TEST(CentreLineCoverage, DoesNotCountTwice) {
  EXPECT_NEAR(score_tubes({straight}, {along_x({0, 0.2}), along_x({0, 0.2}, 0.001)}).centre_line_coverage,
              0.2125 / 0.5, 0.002);
}

TEST(ScoreTubes, NeedsATrueTube) {
  EXPECT_THROW(score_tubes({}, {straight}), std::invalid_argument);
  EXPECT_THROW(score_tubes({tube_through({{0, 0, 0}})}, {straight}), std::invalid_argument);
  EXPECT_THROW(score_tubes({tube_through({{0, 0, 0}, {0, 0, 0}})}, {straight}), std::invalid_argument);
}

TEST(Joins, OfATubeCutElsewhereAreAllFound) {
  EXPECT_EQ(joins({straight}, {straight}), Counts(0, 0, 0));
  EXPECT_EQ(joins({straight}, {along_x({0.01, 0.1, 0.25, 0.4, 0.49}, 0.003)}), Counts(3, 3, 3));
  EXPECT_EQ(joins({along_x({0, 0.1, 0.2, 0.5})}, {along_x({0.5, 0.3, 0})}), Counts(1, 1, 1));
}

TEST(Joins, OneThatIsMissingIsNotFound) {
  EXPECT_EQ(joins({straight}, {along_x({0, 0.1, 0.2}), along_x({0.2, 0.3, 0.5})}), Counts(3, 2, 2));
}

TEST(Joins, PiecesFarApartOnOneTubeAreNeighboursWhereNothingIsBetween) {
  EXPECT_EQ(joins({straight}, {along_x({0, 0.05}), along_x({0.45, 0.5})}), Counts(1, 0, 0));
}

// Two tubes that cross, one of which hides the middle of the other, modelled as two bent ones.
TEST(Joins, ToAnotherTubeAreWrong) {
  const std::vector<Tube> truth = {tube_through({{-0.25, 0, 0}, {0.25, 0, 0}}),
                                   tube_through({{0, -0.25, 0.025}, {0, 0.25, 0.025}})};
  const Tube turns_left = tube_through({{-0.25, 0, 0}, {-0.05, 0, 0}, {0, 0.05, 0.025}, {0, 0.25, 0.025}});
  const Tube turns_right = tube_through({{0, -0.25, 0.025}, {0, -0.05, 0.025}, {0.05, 0, 0}, {0.25, 0, 0}});
  EXPECT_EQ(joins(truth, {turns_left, turns_right}), Counts(2, 0, 2));
}

TEST(Joins, ThatPassOverAPieceAreWrong) {
  // From the first piece over the second to the third, which is on its own.
  const Tube over = tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.25, 0, 0.05}, {0.4, 0, 0}, {0.5, 0, 0}});
  EXPECT_EQ(joins({straight}, {over, along_x({0.2, 0.3})}), Counts(2, 0, 1));
}

TEST(Joins, AHiddenBendIsBridgedByALink) {
  const Tube bent = tube_through({{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}});
  const Tube across = tube_through({{0, 0, 0}, {0.12, 0, 0}, {0.2, 0.08, 0}, {0.2, 0.2, 0}});
  EXPECT_EQ(joins({bent}, {across}), Counts(1, 1, 1));
  const Tube around = tube_through({{0, 0, 0}, {0.12, 0, 0}, {0.2, 0, 0}, {0.2, 0.08, 0}, {0.2, 0.2, 0}});
  EXPECT_EQ(joins({bent}, {around}), Counts(3, 3, 3));
}

TEST(Joins, ALinkThatEndsNowhereJoinsNothing) {
  const Tube astray = tube_through({{0.4, 0, 0}, {0.5, 0, 0}, {0.6, 0, 0.1}, {0.6, 0.1, 0.1}});
  EXPECT_EQ(joins({straight}, {along_x({0, 0.1}), astray}), Counts(1, 0, 0));
}

TEST(Joins, CylindersThatOverlapAreJoinedByAnEdgeThatLeadsBack) {
  const Tube back = tube_through({{0, 0, 0}, {0.26, 0, 0}, {0.24, 0.002, 0}, {0.5, 0.002, 0}});
  EXPECT_EQ(joins({straight}, {back}), Counts(1, 1, 1));
}

TEST(Joins, ASecondFitToThePartOfAPieceIsNoPiece) {
  const Tube modelled = along_x({0, 0.25, 0.5});
  EXPECT_EQ(joins({straight}, {modelled, along_x({0.1, 0.2}, 0.004)}), Counts(1, 1, 1));
}

TEST(Joins, APieceBelongsToTheNearestTube) {
  // Side by side, as tubes that touch are, and both within a radius of what is between them.
  const std::vector<Tube> truth = {straight, along_x({0, 0.5}, 0.02)};
  EXPECT_EQ(joins(truth, {along_x({0, 0.25, 0.5}, 0.009)}), Counts(1, 1, 1));
  EXPECT_EQ(joins(truth, {along_x({0, 0.25}, 0.009), along_x({0.25, 0.5}, 0.011)}), Counts(0, 0, 0));
}

TEST(Joins, AnEdgeIsAPieceWhereItsEndsAndMiddleAreWithinARadius) {
  const auto from_height = [](double height) {
    return tube_through({{0, 0, 0}, {0.2, 0, 0}, {0.4, 0, height}});
  };
  EXPECT_EQ(joins({straight}, {from_height(0.012)}), Counts(1, 1, 1));
  EXPECT_EQ(joins({straight}, {from_height(0.013)}), Counts(0, 0, 0));
  // A chord whose ends alone are on the tube.
  const Tube bent = tube_through({{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.2, 0}});
  EXPECT_EQ(joins({bent}, {tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.1, 0}})}), Counts(0, 0, 0));
}

// Three branches of 0.2 m from the origin.
Tube star() {
  Tube tube = tube_through({{-0.2, 0, 0}, {0, 0, 0}, {0.2, 0, 0}});
  add_branch(tube, 1, {{0, 0.2, 0}});
  return tube;
}

TEST(Joins, AroundAJunctionEachPieceIsANeighbourOfEach) {
  EXPECT_EQ(joins({star()}, {star()}), Counts(3, 3, 3));
  // Two pieces on each branch.
  Tube finer = tube_through({{-0.2, 0, 0}, {-0.1, 0, 0}, {0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}});
  add_branch(finer, 2, {{0, 0.1, 0}, {0, 0.2, 0}});
  EXPECT_EQ(joins({star()}, {finer}), Counts(6, 6, 6));
}

TEST(Joins, ABranchThatIsCutOffLacksItsTwo) {
  const Tube bar = tube_through({{-0.2, 0, 0}, {0, 0, 0}, {0.2, 0, 0}});
  const Tube branch = tube_through({{0, 0.05, 0}, {0, 0.2, 0}});
  EXPECT_EQ(joins({star()}, {bar, branch}), Counts(3, 1, 1));
}

TEST(Joins, AHiddenJunctionIsBridgedByLinks) {
  // Three cylinders, linked to a node off the junction.
  Tube modelled = tube_through({{-0.2, 0, 0}, {-0.05, 0, 0}, {0, 0, 0.04}, {0.05, 0, 0}, {0.2, 0, 0}});
  add_branch(modelled, 2, {{0, 0.05, 0}, {0, 0.2, 0}});
  EXPECT_EQ(joins({star()}, {modelled}), Counts(3, 3, 3));
}

TEST(Joins, APieceAcrossAJunctionIsNextToTheBranch) {
  Tube modelled = tube_through({{-0.2, 0, 0}, {-0.06, 0, 0}, {0.05, 0, 0}, {0.2, 0, 0}});
  add_branch(modelled, 2, {{0, 0.05, 0}, {0, 0.2, 0}});
  // The middle piece is next to all others, and the branch, whose link starts at the piece's end, next to
  // the one behind it too.
  EXPECT_EQ(joins({star()}, {modelled}), Counts(4, 4, 4));
}

// Drawn tubes with room around them, and a model of them: most of their edges, some millimetres off, in
// chains that go on with the next edge or with any other.
struct Scene {
  std::vector<Tube> truth;
  std::vector<Tube> modelled;
};

std::vector<Tube> any_tubes(Rng& rng) {
  std::vector<Tube> tubes;
  for (int id = 1; id <= 3; ++id) {
    tubes.push_back(draw_tube(rng, id == 3 ? test::tree_spec() : test::chain_spec(45), id));
    const auto coordinate = [&] { return uniform_real(rng, -0.1, 0.1); };
    transform(tubes.back(),
              Eigen::Isometry3d(Eigen::Translation3d(coordinate(), coordinate(), coordinate())));
  }
  return tubes;
}

std::vector<Tube> any_model(Rng& rng, const std::vector<Tube>& truth) {
  const auto jitter = [&] { return uniform_real(rng, -0.003, 0.003); };
  const auto near = [&](const Vector3d& point) {
    return Vector3d(point + Vector3d(jitter(), jitter(), jitter()));
  };
  std::vector<Capsule> cylinders;
  for (const Tube& tube : truth) {
    for (const Capsule& capsule : capsules(tube)) {
      if (uniform_real(rng, 0, 1) < 0.2) continue;
      cylinders.push_back({near(capsule.a), near(capsule.b), capsule.radius});
      if (uniform_real(rng, 0, 1) < 0.2) {
        std::swap(cylinders.back(), cylinders[rng() % cylinders.size()]);
      }
    }
  }
  std::vector<Tube> tubes;
  std::vector<Vector3d> points;
  for (const Capsule& cylinder : cylinders) {
    points.push_back(cylinder.a);
    points.push_back(cylinder.b);
    if (uniform_real(rng, 0, 1) < 0.8) continue;
    tubes.push_back(tube_through(points));
    points.clear();
  }
  tubes.push_back(tube_through(points));
  return tubes;
}

Scene any_scene() {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<Tube> truth = any_tubes(rng);
  std::vector<Tube> modelled = any_model(rng, truth);
  return {std::move(truth), std::move(modelled)};
}

void assert_same(const TubesScore& a, const TubesScore& b) {
  RC_ASSERT(std::abs(*a.centre_line_error - *b.centre_line_error) < rounding);
  RC_ASSERT(std::abs(*a.centre_line_error_p95 - *b.centre_line_error_p95) < rounding);
  RC_ASSERT(std::abs(a.centre_line_coverage - b.centre_line_coverage) < rounding);
  RC_ASSERT(a.true_joins == b.true_joins);
  RC_ASSERT(a.joins_found == b.joins_found);
  RC_ASSERT(a.joins_made == b.joins_made);
  RC_ASSERT(a.complete_tubes == b.complete_tubes);
  RC_ASSERT(std::abs(a.length_error.value_or(0) - b.length_error.value_or(0)) < 1e-9);
  RC_ASSERT(a.true_junctions == b.true_junctions);
  RC_ASSERT(a.junctions_found == b.junctions_found);
  RC_ASSERT(a.junctions_made == b.junctions_made);
}

std::int64_t joins_at_nodes(const std::vector<Tube>& tubes) {
  std::int64_t sum = 0;
  for (const Tube& tube : tubes) {
    std::vector<std::int64_t> degrees(tube.nodes.size());
    for (const Edge& edge : tube.edges) {
      sum += degrees[edge.from]++;
      sum += degrees[edge.to]++;
    }
  }
  return sum;
}

RC_GTEST_PROP(ScoreTubes, TheTruthIsAPerfectModel, ()) {
  const std::vector<Tube> truth = any_scene().truth;
  const TubesScore score = score_tubes(truth, truth);
  RC_ASSERT(*score.centre_line_error_p95 < rounding);
  RC_ASSERT(score.centre_line_coverage == 1.0);
  RC_ASSERT(score.true_joins == joins_at_nodes(truth));
  RC_ASSERT(score.joins_found == score.true_joins);
  RC_ASSERT(score.joins_made == score.true_joins);
  RC_ASSERT(score.complete_tubes == std::ssize(truth));
  RC_ASSERT(*score.length_error < rounding);
  RC_ASSERT(score.true_junctions > 0);
  RC_ASSERT(score.junctions_found == score.true_junctions);
  RC_ASSERT(score.junctions_made == score.true_junctions);
}

RC_GTEST_PROP(ScoreTubes, NoMoreJoinsAreFoundThanThereAreOrAreMade, ()) {
  const Scene scene = any_scene();
  const TubesScore score = score_tubes(scene.truth, scene.modelled);
  RC_ASSERT(score.joins_found <= score.true_joins);
  RC_ASSERT(score.joins_found <= score.joins_made);
  RC_ASSERT(*score.centre_line_error <= *score.centre_line_error_p95);
}

RC_GTEST_PROP(ScoreTubes, ARigidMotionOfBothChangesNothing, ()) {
  Scene scene = any_scene();
  const TubesScore before = score_tubes(scene.truth, scene.modelled);
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto coordinate = [&] { return uniform_real(rng, -1, 1); };
  const auto vector = [&] { return Vector3d(coordinate(), coordinate(), coordinate()); };
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(vector()) * Eigen::AngleAxisd(4 * coordinate(), vector().normalized());
  for (Tube& tube : scene.truth) transform(tube, motion);
  for (Tube& tube : scene.modelled) transform(tube, motion);
  assert_same(score_tubes(scene.truth, scene.modelled), before);
}

template <class T>
void shuffle(std::vector<T>& items) {
  for (std::size_t i = 1; i < items.size(); ++i) std::swap(items[i], items[*integer<std::size_t>(0, i + 1)]);
}

// The same tube with its nodes and edges in another order, and some edges the other way round.
Tube rewritten(const Tube& tube) {
  std::vector<std::size_t> order(tube.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  shuffle(order);
  Tube result = tube;
  for (std::size_t i = 0; i < order.size(); ++i) result.nodes[order[i]] = tube.nodes[i];
  for (Edge& edge : result.edges) {
    edge.from = order[edge.from];
    edge.to = order[edge.to];
    if (*rc::gen::arbitrary<bool>()) std::swap(edge.from, edge.to);
  }
  shuffle(result.edges);
  return result;
}

RC_GTEST_PROP(ScoreTubes, NeitherTheOrderOfTubesNodesAndEdgesNorTheirDirectionMatters, ()) {
  Scene scene = any_scene();
  const TubesScore before = score_tubes(scene.truth, scene.modelled);
  for (std::vector<Tube>* tubes : {&scene.truth, &scene.modelled}) {
    for (Tube& tube : *tubes) tube = rewritten(tube);
    shuffle(*tubes);
  }
  assert_same(score_tubes(scene.truth, scene.modelled), before);
}

RC_GTEST_PROP(ScoreTubes, ATubeThatIsCutLosesTheJoinsThere, ()) {
  const std::vector<Tube> truth = any_scene().truth;
  const Tube& chain = truth.front();
  const auto cut = *integer<std::size_t>(1, chain.edges.size());
  std::vector<Tube> modelled(truth.begin() + 1, truth.end());
  Tube first = chain;
  Tube second = chain;
  first.edges.erase(first.edges.begin() + static_cast<std::ptrdiff_t>(cut), first.edges.end());
  second.edges.erase(second.edges.begin(), second.edges.begin() + static_cast<std::ptrdiff_t>(cut));
  modelled.push_back(first);
  modelled.push_back(second);
  const std::int64_t all = joins_at_nodes(truth);
  RC_ASSERT(joins(truth, modelled) == Counts(all, all - 1, all - 1));
}

}  // namespace
}  // namespace tanglebin
