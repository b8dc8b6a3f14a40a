#include "tanglebin/geometry/tube.hpp"

#include <cmath>

namespace tanglebin {
namespace {

// Adding zero turns a negative zero into a positive one.
double to_billionth(double value) {
  return std::round(value * 1e9) / 1e9 + 0.0;
}

}  // namespace

Capsule capsule(const Tube& tube, const Edge& edge) {
  return {tube.nodes[edge.from].position, tube.nodes[edge.to].position, tube.radius};
}

std::vector<Capsule> capsules(const Tube& tube) {
  std::vector<Capsule> result;
  result.reserve(tube.edges.size());
  for (const Edge& edge : tube.edges) result.push_back(capsule(tube, edge));
  return result;
}

double total_length(const Tube& tube) {
  double length = 0;
  for (const Edge& edge : tube.edges) length += edge.length;
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
  const Eigen::Quaterniond rotation(motion.linear());
  for (Node& node : tube.nodes) node.position = motion * node.position;
  for (Edge& edge : tube.edges) {
    edge.centre = motion * edge.centre;
    edge.rotation = (rotation * edge.rotation).normalized();
  }
}

void round_to_nanometres(Tube& tube) {
  const auto round_vector = [](auto&& vector) { vector = vector.unaryExpr(&to_billionth).eval(); };
  for (Node& node : tube.nodes) round_vector(node.position);
  for (Edge& edge : tube.edges) {
    round_vector(edge.centre);
    round_vector(edge.rotation.coeffs());
    edge.length = to_billionth(edge.length);
  }
}

}  // namespace tanglebin
