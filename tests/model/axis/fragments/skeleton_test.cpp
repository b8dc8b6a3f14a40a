#include "tanglebin/model/axis/fragments/skeleton.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double voxel = 0.004;
constexpr double step = 0.005;
constexpr double branch_min = 0.02;

void add_line(std::vector<Vector3f>& points, const Vector3d& from, const Vector3d& to) {
  constexpr int count = 400;
  for (int i = 0; i <= count; ++i) points.push_back((from + (to - from) * i / count).cast<float>());
}

// Of votes, m.
Vector3f scatter(Rng& rng) {
  const auto offset = [&] { return static_cast<float>(uniform_real(rng, -0.001, 0.001)); };
  return {offset(), offset(), offset()};
}

double length_of(const Skeleton& skeleton) {
  double length = 0;
  for (std::size_t i = 1; i < skeleton.nodes.size(); ++i) {
    length += (skeleton.nodes[i] - skeleton.nodes[skeleton.parents[i]]).norm();
  }
  return length;
}

std::size_t leaves_of(const Skeleton& skeleton) {
  std::vector<int> degree(skeleton.nodes.size());
  for (std::size_t i = 1; i < skeleton.nodes.size(); ++i) {
    ++degree[i];
    ++degree[skeleton.parents[i]];
  }
  return static_cast<std::size_t>(std::ranges::count(degree, 1));
}

TEST(Skeletons, FollowACurveFromEndToEnd) {
  std::vector<Vector3f> half_circle;
  constexpr double radius = 0.1;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = std::numbers::pi * i / 1000;
    half_circle.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.05);
  }
  const std::vector<Skeleton> found = find_skeletons(half_circle, voxel, step, branch_min);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].points.size(), half_circle.size());
  EXPECT_EQ(leaves_of(found[0]), 2U);
  // The first and the last node are half a step from the ends.
  EXPECT_NEAR(length_of(found[0]), std::numbers::pi * radius - step, 0.006);
  for (const Vector3d& node : found[0].nodes) EXPECT_NEAR(node.head<2>().norm(), radius, 0.0005);
}

// A shifted grid sees what the points show that are moved the other way.
TEST(Skeletons, FollowTheGridOfVoxels) {
  std::vector<Vector3f> here;
  add_line(here, {0.0011F, 0.0007F, 0.0013F}, {0.07F, 0.03F, 0.01F});
  constexpr double shift = 0.5;  // voxels
  std::vector<Vector3f> moved = here;
  for (Vector3f& point : moved) point.array() -= static_cast<float>(shift * voxel);
  CutSettings settings{.branch_min = branch_min,
                       .spread_max = std::numeric_limits<double>::infinity(),
                       .share_min = 0,
                       .weak_max = 0,
                       .parallel_max = 1,
                       .may_branch = true};
  const std::vector<Skeleton> plain = find_skeletons(moved, {}, voxel, step, settings);
  settings.shift = shift;
  const std::vector<Skeleton> shifted = find_skeletons(here, {}, voxel, step, settings);
  ASSERT_EQ(shifted.size(), plain.size());
  ASSERT_EQ(shifted[0].nodes.size(), plain[0].nodes.size());
  for (std::size_t node = 0; node < plain[0].nodes.size(); ++node) {
    const Vector3d back = shifted[0].nodes[node].array() - shift * voxel;
    EXPECT_LT((back - plain[0].nodes[node]).norm(), 1e-6);
  }
}

TEST(Skeletons, OfSeparateCurvesAreSeparate) {
  std::vector<Vector3f> points;
  add_line(points, {0, 0, 0}, {0.1, 0, 0});
  add_line(points, {0, 0.012, 0}, {0.1, 0.012, 0});
  points.emplace_back(Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  const std::vector<Skeleton> found = find_skeletons(points, voxel, step, branch_min);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].points.size() + found[1].points.size(), points.size() - 1);
}

TEST(Skeletons, HaveTheBranchesThatAreLongEnough) {
  std::vector<Vector3f> points;
  add_line(points, {-0.1, 0, 0}, {0.1, 0, 0});
  add_line(points, {0, 0, 0}, {0, 0.05, 0});        // a branch
  add_line(points, {0.05, 0, 0}, {0.05, 0, 0.01});  // too short for one
  const std::vector<Skeleton> found = find_skeletons(points, voxel, step, branch_min);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(leaves_of(found[0]), 3U);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(leaves_of(find_skeletons(points, voxel, step, infinity).at(0)), 2U);
}

TEST(Skeletons, BranchAsOftenAsTheCurvesHoweverTheseLie) {
  const Vector3d axis = Vector3d(1, 2, 3).normalized();
  Rng rng;
  for (int degrees = 0; degrees < 360; ++degrees) {
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, axis);
    std::vector<Vector3f> points;
    for (const Vector3d& end : {Vector3d(-0.1, 0, 0), Vector3d(0.08, 0.04, 0), Vector3d(0.08, -0.04, 0)})
      add_line(points, Vector3d::Zero(), turn * end);
    for (Vector3f& point : points) point += scatter(rng);
    const std::vector<Skeleton> found = find_skeletons(points, voxel, step, branch_min);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(leaves_of(found[0]), 3U) << degrees << " degrees";
  }
}

TEST(Skeletons, OfAPointAreOneNode) {
  const std::vector<Skeleton> found = find_skeletons({{1, 2, 3}, {1, 2, 3}}, voxel, step, branch_min);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].nodes, std::vector<Vector3d>{Vector3d(1, 2, 3)});
  EXPECT_TRUE(find_skeletons({}, voxel, step, branch_min).empty());
}

/// Votes with the normals that led to them.
struct Votes {
  std::vector<Vector3f> points;
  std::vector<Vector3f> normals;

  // `count` votes along a line, with normals up to an angle from the z axis: seen from all sides above.
  void add_tube(const Vector3d& from, const Vector3d& to, int count, double most = std::numbers::pi / 2) {
    for (int i = 0; i < count; ++i) {
      points.push_back((from + (to - from) * i / count).cast<float>());
      const double angle = most * (i % 7 - 3) / 3;
      normals.push_back(Vector3d(0, std::sin(angle), std::cos(angle)).cast<float>());
    }
  }

  // `count` votes in a horizontal ring or disc, from a plane above.
  void add_ring(const Vector3d& middle, double from, double to, int count) {
    Rng rng(7);
    for (int i = 0; i < count; ++i) {
      const double way = std::sqrt(uniform_real(rng, from * from, to * to));
      const double angle = uniform_real(rng, 0, 2 * std::numbers::pi);
      points.push_back((middle + way * Vector3d(std::cos(angle), std::sin(angle), 0)).cast<float>());
      normals.emplace_back(0, 0, 1);
    }
  }

  void add_plane(const Vector3d& corner) {
    Rng rng(5);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d place(uniform_real(rng, 0, 0.2), uniform_real(rng, 0, 0.1), 0);
      points.push_back((corner + place).cast<float>());
      normals.emplace_back(0, 0, 1);
    }
  }
};

constexpr CutSettings cut{.branch_min = branch_min,
                          .spread_max = 0.006,
                          .share_min = 0.85,
                          .weak_max = 0,
                          .parallel_max = 0.96,
                          .may_branch = false};

std::vector<Skeleton> pieces_of(const Votes& votes, const CutSettings& settings = cut) {
  return find_skeletons(votes.points, votes.normals, voxel, step, settings);
}

TEST(Skeletons, OfTwoTubesAreCutAtAWeakBridge) {
  Votes votes;
  votes.add_tube({-0.1, 0, 0}, {0.1, 0, 0}, 4000);
  votes.add_tube({0, -0.1, 0.03}, {0, 0.1, 0.03}, 4000);
  const std::size_t of_tubes = votes.points.size();
  votes.add_tube({0, 0, 0}, {0, 0, 0.03}, 30);  // a ramp from one to the other
  const std::vector<Skeleton> found = pieces_of(votes);
  ASSERT_EQ(found.size(), 2U);
  for (const Skeleton& skeleton : found) {
    EXPECT_EQ(leaves_of(skeleton), 2U);
    EXPECT_NEAR(length_of(skeleton), 0.2, 0.01);
    EXPECT_NEAR(static_cast<double>(skeleton.points.size()), 4000, 100);
  }
  EXPECT_LE(found[0].points.size() + found[1].points.size(), of_tubes + 5);
}

TEST(Skeletons, OfAChainAreCutWhereItForks) {
  Votes votes;
  votes.add_tube({-0.1, 0, 0}, {0.1, 0, 0}, 4000);
  votes.add_tube({0, 0, 0}, {0, 0.1, 0}, 2000);
  const std::vector<Skeleton> found = pieces_of(votes);
  ASSERT_EQ(found.size(), 3U);
  for (const Skeleton& skeleton : found) EXPECT_NEAR(length_of(skeleton), 0.1, 0.02);
  CutSettings tree = cut;
  tree.may_branch = true;
  EXPECT_EQ(pieces_of(votes, tree).size(), 1U);
}

TEST(Skeletons, AreNotCutOutOfAPlane) {
  Votes votes;
  votes.add_plane(Vector3d::Zero());
  EXPECT_TRUE(pieces_of(votes).empty());
}

// A camera of few pixels sees no flanks: the normals of a tube are nearly parallel.
TEST(Skeletons, AreCutOutOfWhatIsAsFlatAsTheOtherTubes) {
  constexpr double most = 0.3;  // rad
  Votes fork;
  fork.add_tube({-0.1, 0, 0}, {0.1, 0, 0}, 4000, most);
  fork.add_tube({0, 0, 0}, {0, 0.1, 0}, 2000, most);
  EXPECT_TRUE(pieces_of(fork).empty());
  Votes votes = fork;
  votes.add_tube({-0.1, -0.1, 0}, {0.1, -0.1, 0}, 4000, most);
  votes.add_plane({0.2, 0, 0});
  EXPECT_EQ(pieces_of(votes).size(), 4U);
}

constexpr double tube_radius = 0.0125;

std::vector<Skeleton> pieces_with_faces(const Votes& votes) {
  CutSettings with_faces = cut;
  with_faces.face_radius = tube_radius;
  return pieces_of(votes, with_faces);
}

void expect_face(const Skeleton& skeleton, const Vector3d& inside) {
  EXPECT_TRUE(skeleton.is_face);
  ASSERT_EQ(skeleton.nodes.size(), 2U);
  EXPECT_LT((skeleton.nodes[0] - inside - Vector3d(0, 0, tube_radius)).norm(), 0.1 * tube_radius);
  EXPECT_LT((skeleton.nodes[1] - inside).norm(), 0.1 * tube_radius);
}

// Of a tube that is seen end-on.
TEST(Skeletons, OfAFlatEndLeadInwardsFromItsMiddle) {
  Votes votes;
  votes.add_ring({0.1, 0, 0.2}, 0, 0.8 * tube_radius, 400);
  votes.add_tube({-0.1, 0.1, 0}, {0.1, 0.1, 0}, 4000);
  const std::vector<Skeleton> found = pieces_with_faces(votes);
  ASSERT_EQ(found.size(), 2U);
  expect_face(found[0], {0.1, 0, 0.2});
  EXPECT_EQ(found[0].points.size(), 400U);
  EXPECT_FALSE(found[1].is_face);
  for (const Skeleton& skeleton : pieces_of(votes)) EXPECT_FALSE(skeleton.is_face);
}

// The side is seen only where the tube leans, or beside the middle of the image.
TEST(Skeletons, OfAFlatEndAreCutFromThoseOfTheSide) {
  Votes votes;
  votes.add_ring({0.1, 0, 0.2}, 0, 0.8 * tube_radius, 400);
  votes.add_tube({0.1, 0, 0.2}, {0.1, 0, 0.14}, 200);
  const std::vector<Skeleton> found = pieces_with_faces(votes);
  ASSERT_EQ(found.size(), 2U);
  const bool is_first = found[0].is_face;
  expect_face(found[is_first ? 0 : 1], {0.1, 0, 0.2});
  EXPECT_NEAR(length_of(found[is_first ? 1 : 0]), 0.06, 0.02);
}

// Around it the plane goes on, though it hangs together with nothing there.
TEST(Skeletons, OfAPartOfAPlaneAreNoFlatEnd) {
  Votes votes;
  votes.add_ring({0.1, 0, 0.2}, 0, 0.7 * tube_radius, 400);
  votes.add_ring({0.1, 0, 0.2}, 1.5 * tube_radius, 4 * tube_radius, 10000);
  for (const Skeleton& skeleton : pieces_with_faces(votes)) EXPECT_FALSE(skeleton.is_face);
}

TEST(Skeletons, LeaveOutWeakVoxelsFromTheStart) {
  Votes votes;
  votes.add_tube({0, 0, 0}, {0.1, 0, 0}, 4000);
  votes.add_tube({0.1, 0, 0}, {0.13, 0, 0.03}, 40);  // what a ramp adds to the end
  ASSERT_EQ(pieces_of(votes).size(), 1U);
  EXPECT_GT(length_of(pieces_of(votes)[0]), 0.13);
  CutSettings strong = cut;
  strong.weak_max = 0.1;
  ASSERT_EQ(pieces_of(votes, strong).size(), 1U);
  EXPECT_NEAR(length_of(pieces_of(votes, strong)[0]), 0.1, 0.01);
}

}  // namespace
}  // namespace tanglebin
