#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

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

}  // namespace tanglebin
