#include "tanglebin/geometry/tube.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tanglebin/generate/generate.hpp"
#include "tests/geometry/example_tubes.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::rounding;

Tube any_tree() {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  return draw_tube(rng, test::tree_spec(), 1);
}

Eigen::Isometry3d any_motion() {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const auto coordinate = [&] { return uniform_real(rng, -1, 1); };
  const auto vector = [&] { return Vector3d(coordinate(), coordinate(), coordinate()); };
  return Eigen::Translation3d(vector()) * Eigen::AngleAxisd(4 * coordinate(), vector().normalized());
}

TEST(Tube, HasACapsuleForEveryEdge) {
  const Tube tube = test::tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.2, 0}});
  const std::vector<Capsule> all = capsules(tube);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].a, Vector3d(0.1, 0, 0));
  EXPECT_EQ(all[1].b, Vector3d(0.1, 0.2, 0));
  EXPECT_EQ(all[1].radius, 0.0125);
  EXPECT_DOUBLE_EQ(total_length(tube), 0.3);
}

TEST(Tube, WhatIsNoTubeIsNamed) {
  const Tube tube = test::tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.2, 0}});
  const auto complaint_of = [&](const auto& change) {
    Tube changed = tube;
    changed.id = 4;
    change(changed);
    return test::complaint([&] { validate(std::vector{tube, changed}); });
  };
  EXPECT_EQ(complaint_of([](Tube&) {}), "none");
  for (const int id : {0, -1}) {
    EXPECT_EQ(complaint_of([id](Tube& its) { its.id = id; }),
              fmt::format("id of tube {0}: found {0}, expected 1 or more", id));
  }
  EXPECT_EQ(complaint_of([](Tube& its) { its.radius = 0; }),
            "radius of tube 4: found 0, expected a positive number of metres");
  EXPECT_EQ(complaint_of([](Tube& its) { its.nodes[1].position.y() = std::nan(""); }),
            "nodes of tube 4: found a position that is not finite, expected finite numbers");
  EXPECT_EQ(complaint_of([](Tube& its) { its.edges[0].to = 1'000'000'000'000; }),
            "edges of tube 4: found 1000000000000, expected the index of one of 3 nodes");
  const std::string no_tree =
      "edges of tube 4: found no tree, expected edges that connect all nodes without a loop";
  EXPECT_EQ(complaint_of([](Tube& its) { its.edges.pop_back(); }), no_tree);
  EXPECT_EQ(complaint_of([](Tube& its) { its.edges[1] = {1, 0, 2}; }), no_tree);
  EXPECT_EQ(complaint_of([](Tube& its) { its = Tube{.id = 4, .radius = 1, .nodes = {}, .edges = {}}; }),
            no_tree);
}

TEST(Tube, FitsItsBoundsTightly) {
  const Tube tube = test::tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.2, -0.3}});
  EXPECT_TRUE(bounds(tube).min().isApprox(Vector3d(-0.0125, -0.0125, -0.3125), rounding));
  EXPECT_TRUE(bounds(tube).max().isApprox(Vector3d(0.1125, 0.2125, 0.0125), rounding));
}

RC_GTEST_PROP(Transform, KeepsTheDistancesOfAllNodes, ()) {
  const Tube before = any_tree();
  Tube after = before;
  transform(after, any_motion());
  for (std::size_t i = 0; i < before.nodes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double distance = (before.nodes[i].position - before.nodes[k].position).norm();
      RC_ASSERT(std::abs((after.nodes[i].position - after.nodes[k].position).norm() - distance) < rounding);
    }
  }
}

TEST(EdgeFrame, IsWhereTheCylinderIs) {
  const Tube tube = test::tube_through({{0, 0, 0}, {0.3, 0, 0.4}});
  const auto [centre, rotation, length] = frame_of(tube, tube.edges[0]);
  EXPECT_EQ(centre, Vector3d(0.15, 0, 0.2));
  EXPECT_DOUBLE_EQ(length, 0.5);
  EXPECT_TRUE((rotation * Vector3d::UnitZ()).isApprox(Vector3d(0.6, 0, 0.8), rounding));
  EXPECT_NEAR(rotation.angularDistance(Eigen::Quaterniond::Identity()), std::acos(0.8), rounding)
      << "no turn about the cylinder's own axis";
}

RC_GTEST_PROP(EdgeFrame, TurnsZAlongTheEdgeWhereverItIs, ()) {
  Tube tube = any_tree();
  transform(tube, any_motion());
  for (const Edge& edge : tube.edges) {
    const Vector3d& a = tube.nodes[edge.from].position;
    const Vector3d& b = tube.nodes[edge.to].position;
    const auto [centre, rotation, length] = frame_of(tube, edge);
    RC_ASSERT((centre - (a + b) / 2).norm() < rounding);
    RC_ASSERT((rotation * Vector3d::UnitZ() * length - (b - a)).norm() < rounding);
    RC_ASSERT(std::abs(rotation.norm() - 1) < rounding);
  }
}

TEST(RotationFromZ, OfZAndItsOpposite) {
  EXPECT_EQ(rotation_from_z(Vector3d::UnitZ()).coeffs(), Eigen::Quaterniond::Identity().coeffs());
  EXPECT_TRUE(
      (rotation_from_z(-Vector3d::UnitZ()) * Vector3d::UnitZ()).isApprox(-Vector3d::UnitZ(), rounding));
}

RC_GTEST_PROP(Transform, IsUndoneByItsInverse, ()) {
  const Tube before = any_tree();
  const Eigen::Isometry3d motion = any_motion();
  Tube after = before;
  transform(after, motion);
  transform(after, motion.inverse());
  for (std::size_t i = 0; i < before.nodes.size(); ++i) {
    RC_ASSERT((after.nodes[i].position - before.nodes[i].position).norm() < rounding);
  }
}

RC_GTEST_PROP(RoundToNanometres, MovesNothingByMoreThanHalfAndHasNothingLeftToDo, ()) {
  const Tube before = any_tree();
  Tube once = before;
  round_to_nanometres(once);
  Tube twice = once;
  round_to_nanometres(twice);
  for (std::size_t i = 0; i < before.nodes.size(); ++i) {
    const Vector3d shift = once.nodes[i].position - before.nodes[i].position;
    RC_ASSERT(shift.cwiseAbs().maxCoeff() < 0.5e-9 + 1e-15);
    RC_ASSERT(twice.nodes[i].position == once.nodes[i].position);
  }
}

}  // namespace
}  // namespace tanglebin
