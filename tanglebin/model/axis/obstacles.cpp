#include "tanglebin/model/axis/obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/model/axis/voxel.hpp"

namespace tanglebin {

using Eigen::Vector3d;
using Eigen::Vector3i;

Obstacles::Obstacles(const std::vector<Fragment>& fragments, double radius) : diameter_(2 * radius) {
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (const Vector3d& node : fragments[i].nodes) {
      const Vector3i cell = voxel_at(node, diameter_);
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) around_[voxel_key(cell + Vector3i(x, y, z))].push_back({node, i});
        }
      }
    }
  }
}

double Obstacles::overlap(const Vector3d& axis, std::size_t first, std::size_t second) const {
  const auto found = around_.find(voxel_key(voxel_at(axis, diameter_)));
  if (found == around_.end()) return 0;
  double nearest = diameter_ * diameter_;  // m², squared distance
  for (const Node& node : found->second) {
    if (node.fragment == first || node.fragment == second) continue;
    nearest = std::min(nearest, (node.position - axis).squaredNorm());
  }
  return 1 - std::sqrt(nearest) / diameter_;
}

}  // namespace tanglebin
