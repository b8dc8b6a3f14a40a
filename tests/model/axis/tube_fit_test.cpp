#include "tanglebin/model/axis/tube_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tanglebin/score/score_tubes.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

using test::radius;

/// A fragment along straight pieces, and points on the upper half of the tube around them.
struct Piece {
  Fragment fragment;
  std::vector<Vector3f> points;
};

// The fragment's nodes are beside the axis by `error`.
Piece piece_along(const std::vector<Vector3d>& corners, std::size_t first_point, const Vector3d& error) {
  Piece piece{};
  constexpr int steps = 20;
  constexpr int around = 9;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vector3d way = (corners[i + 1] - corners[i]).normalized();
    const Vector3d side = way.cross(Vector3d::UnitZ()).normalized();
    const Vector3d up = side.cross(way);
    for (int step = 0; step <= steps; ++step) {
      const Vector3d axis = corners[i] + (corners[i + 1] - corners[i]) * step / steps;
      piece.fragment.nodes.push_back(axis + error);
      for (int j = 1; j < around; ++j) {
        const double angle = std::numbers::pi * j / around;
        const Vector3d normal = std::cos(angle) * side + std::sin(angle) * up;
        piece.fragment.points.push_back(first_point + piece.points.size());
        piece.points.push_back((axis + radius * normal).cast<float>());
      }
    }
  }
  Fragment& fragment = piece.fragment;
  for (std::size_t node = 0; node < fragment.nodes.size(); ++node)
    fragment.parents.push_back(node == 0 ? 0 : node - 1);
  const std::size_t last = fragment.nodes.size() - 1;
  fragment.ends = {
      {0, fragment.nodes[0], (fragment.nodes[0] - fragment.nodes[1]).normalized()},
      {last, fragment.nodes[last], (fragment.nodes[last] - fragment.nodes[last - 1]).normalized()}};
  return piece;
}

TEST(FitTube, MovesTheCentreLineSoThatTheSurfaceIsOnThePoints) {
  const std::vector<Vector3d> corners = {{-0.2, 0, 0.05}, {0, 0.03, 0.05}, {0.2, 0, 0.08}};
  const Piece piece = piece_along(corners, 0, {0, 0, 0.002});
  const Tube tube = fit_tube({piece.fragment}, {0}, {}, {}, piece.points, {.radius = radius}, {});
  EXPECT_EQ(tube.radius, radius);
  const TubesScore score = score_tubes({test::chain(1, radius, corners)}, {tube});
  EXPECT_LT(*score.centre_line_error, 1e-4);
  EXPECT_LT(*score.centre_line_error_p95, 5e-4);
  // As few pieces as follow it: two, and one about the bend at most.
  EXPECT_LE(tube.edges.size(), 3U);
}

TEST(FitTube, BridgesAJoin) {
  Piece first = piece_along({{-0.2, 0, 0.05}, {-0.05, 0, 0.05}}, 0, Vector3d::Zero());
  const Piece second = piece_along({{0.05, 0, 0.05}, {0.2, 0, 0.05}}, first.points.size(), Vector3d::Zero());
  std::vector<Vector3f> points = std::move(first.points);
  points.insert(points.end(), second.points.begin(), second.points.end());
  const std::vector<Link> links = {
      {.kind = LinkKind::chain_ends,
       .fragment = 0,
       .end = 1,
       .to = {1, second.fragment.ends[0].node, 0, second.fragment.ends[0].position},
       .gap = 0.1,
       .features = {}}};
  const Tube tube =
      fit_tube({first.fragment, second.fragment}, {0, 1}, links, {0}, points, {.radius = radius}, {});
  EXPECT_NEAR(total_length(tube), 0.4, 1e-3);
  EXPECT_EQ(tube.nodes.size(), tube.edges.size() + 1);
  for (const Node& node : tube.nodes)
    EXPECT_LT((node.position - Vector3d(node.position.x(), 0, 0.05)).norm(), 1e-4);
}

// Three arms that meet 4 cm before each of them begins.
TEST(FitTube, PutsAHiddenJunctionWhereItsLinkLeads) {
  const Vector3d junction(0, 0, 0.05);
  std::vector<Fragment> arms;
  std::vector<Vector3f> points;
  for (const double angle : {0.0, 2.0, 4.0}) {
    const Vector3d way(std::cos(angle), std::sin(angle), 0);
    Piece arm = piece_along({junction + 0.04 * way, junction + 0.2 * way}, points.size(), Vector3d::Zero());
    arms.push_back(std::move(arm.fragment));
    points.insert(points.end(), arm.points.begin(), arm.points.end());
  }
  const FragmentEnd& end = arms[1].ends[0];
  const std::vector<Link> links = {{LinkKind::tree_ends, 0, 0, {1, end.node, 0, end.position}, 0.07, {}},
                                   {LinkKind::junction, 2, 0, {1, end.node, 0, junction}, 0.04, {}}};
  const Tube tube = fit_tube(arms, {0, 1, 2}, links, {0, 1}, points, {.radius = radius}, {});
  const auto edges_at = [&](std::size_t node) {
    return std::ranges::count_if(tube.edges, [&](const Edge& e) { return e.from == node || e.to == node; });
  };
  std::vector<Vector3d> junctions;
  for (std::size_t node = 0; node < tube.nodes.size(); ++node) {
    if (edges_at(node) == 3) junctions.push_back(tube.nodes[node].position);
  }
  ASSERT_EQ(junctions.size(), 1U);
  EXPECT_LT((junctions[0] - junction).norm(), 1e-3);
}

TEST(FitTube, DoesNotCountPointsThatAreFarFromTheSurface) {
  const std::vector<Vector3d> corners = {{-0.2, 0, 0.05}, {0.2, 0, 0.05}};
  Piece piece = piece_along(corners, 0, Vector3d::Zero());
  for (std::size_t i = 0; i < piece.points.size(); i += 5) piece.points[i].z() += 0.01F;
  const Tube tube = fit_tube({piece.fragment}, {0}, {}, {}, piece.points, {.radius = radius}, {});
  EXPECT_LT(*score_tubes({test::chain(1, radius, corners)}, {tube}).centre_line_error, 1e-4);
}

}  // namespace
}  // namespace tanglebin
