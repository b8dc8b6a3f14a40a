#include "tanglebin/geometry/tube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>

#include "tanglebin/base/expect.hpp"

namespace tanglebin {
namespace {

// A tube's edges, which end at its nodes, one by one join parts that were apart.
bool is_tree(const Tube& tube) {
  if (tube.edges.size() + 1 != tube.nodes.size()) return false;
  boost::disjoint_sets_with_storage<> parts(tube.nodes.size());
  return std::ranges::all_of(tube.edges, [&](const Edge& edge) {
    if (parts.find_set(edge.from) == parts.find_set(edge.to)) return false;
    parts.union_set(edge.from, edge.to);
    return true;
  });
}

void expect_of_tube(bool holds, const char* field, const Tube& tube, const std::string& found,
                    const std::string& expected) {
  if (!holds) expect(false, fmt::format("{} of tube {}", field, tube.id), found, expected);
}

}  // namespace

void validate_lines(const Tube& tube) {
  for (const Node& node : tube.nodes) {
    expect_of_tube(node.position.allFinite(), "nodes", tube, "a position that is not finite",
                   "finite numbers");
  }
  for (const Edge& edge : tube.edges) {
    const std::size_t last = std::max(edge.from, edge.to);
    expect_of_tube(last < tube.nodes.size(), "edges", tube, fmt::format("{}", last),
                   fmt::format("the index of one of {} nodes", tube.nodes.size()));
  }
}

void validate(const Tube& tube) {
  expect_of_tube(tube.id >= 1, "id", tube, fmt::format("{}", tube.id), "1 or more");
  expect_of_tube(std::isfinite(tube.radius) && tube.radius > 0, "radius", tube,
                 fmt::format("{}", tube.radius), "a positive number of metres");
  validate_lines(tube);
  expect_of_tube(is_tree(tube), "edges", tube, "no tree", "edges that connect all nodes without a loop");
}

void validate(const std::vector<Tube>& tubes) {
  for (const Tube& tube : tubes) validate(tube);
}

EdgeFrame frame_of(const Tube& tube, const Edge& edge) {
  return frame_between(tube.nodes[edge.from].position, tube.nodes[edge.to].position);
}

EdgeFrame frame_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  return {(from + to) / 2, rotation_from_z(along.normalized()), along.norm()};
}

// By acos(z · d) about z × d. The arc tangent keeps its digits where d is nearly parallel to z; where it is
// exactly parallel, any axis across z will do.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(direction);
  const double sine = axis.norm();
  const double angle = std::atan2(sine, direction.z());
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(angle, sine > 0 ? Eigen::Vector3d(axis / sine) : Eigen::Vector3d::UnitX()));
}

std::vector<bool> outermost_nodes(const Tube& tube) {
  std::vector<int> edges_at(tube.nodes.size());
  for (const Edge& edge : tube.edges) {
    ++edges_at[edge.from];
    ++edges_at[edge.to];
  }
  std::vector<bool> outermost(tube.nodes.size());
  for (std::size_t i = 0; i < outermost.size(); ++i) outermost[i] = edges_at[i] == 1;
  return outermost;
}

std::vector<Capsule> capsules(const Tube& tube) {
  std::vector<Capsule> result;
  result.reserve(tube.edges.size());
  const std::vector<bool> is_end = outermost_nodes(tube);
  for (const Edge& edge : tube.edges) {
    result.push_back({.a = tube.nodes[edge.from].position,
                      .b = tube.nodes[edge.to].position,
                      .radius = tube.radius,
                      .flat_at_a = tube.flat_ends && is_end[edge.from],
                      .flat_at_b = tube.flat_ends && is_end[edge.to]});
  }
  return result;
}

double total_length(const Tube& tube) {
  double length = 0;
  for (const Edge& edge : tube.edges)
    length += (tube.nodes[edge.to].position - tube.nodes[edge.from].position).norm();
  return length;
}

Eigen::AlignedBox3d bounds(const Tube& tube) {
  Eigen::AlignedBox3d box;
  for (const Node& node : tube.nodes) box.extend(node.position);
  box.min().array() -= tube.radius;
  box.max().array() += tube.radius;
  return box;
}

void transform(Tube& tube, const Eigen::Isometry3d& motion) {
  for (Node& node : tube.nodes) node.position = motion * node.position;
}

// Adding zero turns a negative zero into a positive one.
double to_billionth(double value) {
  return std::round(value * 1e9) / 1e9 + 0.0;
}

void round_to_nanometres(Tube& tube) {
  for (Node& node : tube.nodes) node.position = node.position.unaryExpr(&to_billionth).eval();
}

}  // namespace tanglebin
