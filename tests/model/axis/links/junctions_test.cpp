#include "tanglebin/model/axis/links/junctions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tanglebin/geometry/capsule.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::radius;

constexpr double spacing = 0.005;  // m, between nodes

// Goes on from a node to places in a row; the last node.
std::size_t extend(LineTree& line, std::size_t node, const Vector3d& first, const Vector3d& last) {
  const int steps = static_cast<int>(std::round((last - first).norm() / spacing));
  for (int i = 0; i <= steps; ++i) {
    line.edges.push_back({node, line.nodes.size()});
    node = line.nodes.size();
    line.nodes.emplace_back(first + (last - first) * i / steps);
  }
  return node;
}

// Two branches of 10 cm that leave the origin by `angle` to either side of x, but are seen as one along x up
// to `parted`, which is node 0; and a stem that comes from `stem`.
LineTree fork(double angle, double parted, const Vector3d& stem) {
  LineTree line;
  const Vector3d junction(parted, 0, 0);
  line.nodes.push_back(junction);
  extend(line, 0, junction + spacing * (stem - junction).normalized(), stem);
  for (const double side : {1.0, -1.0}) {
    const Vector3d way(std::cos(angle), side * std::sin(angle), 0);
    extend(line, 0, (parted + spacing) / std::cos(angle) * way, 0.1 * way);
  }
  return line;
}

const Vector3d straight_behind(-0.2, 0, 0);

// How far a node is from the stem or the nearer one of the branches, m.
double error(const Vector3d& node, double angle) {
  const Vector3d branch(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0);
  const Vector3d mirrored(node.x(), std::abs(node.y()), node.z());
  return std::min(axis_distance({{-0.2, 0, 0}, {0, 0, 0}, 0}, node),
                  axis_distance({{0, 0, 0}, branch, 0}, mirrored));
}

TEST(Junctions, AreDrawnBackToWhereSharpBranchesMeet) {
  for (const double degrees : {10.0, 15.0, 25.0, 40.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const double parted = 0.01 / std::tan(angle);
    const LineTree seen = fork(angle, parted, straight_behind);
    const LineTree line = with_junctions_drawn_back(seen, radius);
    EXPECT_EQ(line.edges, seen.edges);
    EXPECT_LT(line.nodes[0].norm(), 1e-9) << degrees;
    for (const Vector3d& node : line.nodes) EXPECT_LT(error(node, angle), 1e-9) << degrees;
  }
}

TEST(Junctions, StayWhereBranchesLeaveAtABluntAngle) {
  const LineTree seen = fork(50 * std::numbers::pi / 180, 0.0, straight_behind);
  EXPECT_EQ(with_junctions_drawn_back(seen, radius).nodes, seen.nodes);
}

TEST(Junctions, StayWhereTheBranchesDoNotMeetOnTheStem) {
  const LineTree seen = fork(15 * std::numbers::pi / 180, 0.04, {0.04, 0, -0.2});
  EXPECT_EQ(with_junctions_drawn_back(seen, radius).nodes, seen.nodes);
}

TEST(Junctions, OfAChainAreNone) {
  LineTree line;
  line.nodes.emplace_back(0, 0, 0);
  extend(line, 0, {spacing, 0, 0}, {0.2, 0, 0});
  EXPECT_EQ(with_junctions_drawn_back(line, radius).nodes, line.nodes);
}

}  // namespace
}  // namespace tanglebin
