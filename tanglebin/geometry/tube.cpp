#include "tanglebin/geometry/tube.hpp"

#include <cmath>

namespace tanglebin {
namespace {

// Adding zero turns a negative zero into a positive one.
double to_billionth(double value) {
  return std::round(value * 1e9) / 1e9 + 0.0;
}

}  // namespace

// By acos(z · d) about z × d. The arc tangent keeps its digits where d is nearly parallel to z; where it is
// exactly parallel, any axis across z will do.
Eigen::Quaterniond rotation_from_z(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(direction);
  const double sine = axis.norm();
  const double angle = std::atan2(sine, direction.z());
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(angle, sine > 0 ? Eigen::Vector3d(axis / sine) : Eigen::Vector3d::UnitX()));
}

Edge edge_between(const Tube& tube, std::size_t from, std::size_t to, int order) {
  const Eigen::Vector3d& a = tube.nodes[from].position;
  const Eigen::Vector3d& b = tube.nodes[to].position;
  return {from, to, order, (a + b) / 2, rotation_from_z((b - a).normalized()), (b - a).norm()};
}

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
