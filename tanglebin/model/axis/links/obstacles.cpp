#include "tanglebin/model/axis/links/obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/model/axis/fragments/voxel.hpp"

namespace tanglebin {

using Eigen::Vector3d;
using Eigen::Vector3i;

Obstacles::Obstacles(const std::vector<Fragment>& fragments, double radius, const std::vector<Ball>& others)
    : cell_(2 * radius) {
  for (const Ball& other : others) cell_ = std::max(cell_, radius + other.radius);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (const Vector3d& node : fragments[i].nodes) add({node, 2 * radius, i});
  }
  for (const Ball& other : others) add({other.centre, radius + other.radius, fragments.size()});
}

void Obstacles::add(const Node& node) {
  const Vector3i cell = voxel_at(node.position, cell_);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) around_[voxel_key(cell + Vector3i(x, y, z))].push_back(node);
    }
  }
}

double Obstacles::overlap(const Vector3d& axis, std::size_t first, std::size_t second) const {
  const auto found = around_.find(voxel_key(voxel_at(axis, cell_)));
  if (found == around_.end()) return 0;
  double deepest = 0;
  for (const Node& node : found->second) {
    if (node.fragment == first || node.fragment == second) continue;
    const double squared = (node.position - axis).squaredNorm();
    if (squared < node.reach * node.reach) deepest = std::max(deepest, 1 - std::sqrt(squared) / node.reach);
  }
  return deepest;
}

}  // namespace tanglebin
