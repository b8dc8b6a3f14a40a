#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {

/// The point a + t (b − a) on the axis of a capsule that another point is nearest to.
struct Foot {
  std::size_t capsule;
  double t;             ///< from 0 to 1
  Eigen::Vector3d way;  ///< m, to the other point
};

/// Finds which of some capsules, of which there is at least one, has the nearest axis. Made for many points
/// of which each is near the one before: it looks first where it found the last one.
class NearestAxis {
public:
  explicit NearestAxis(const std::vector<Capsule>& capsules);

  /// The foot of a point (m) on the nearest axis; of equally near ones, on the first.
  Foot foot_of(const Eigen::Vector3d& point);

private:
  struct Axis {
    Eigen::Vector3d start;
    Eigen::Vector3d way;  // to its end
    double square;        // of its length
    Eigen::Vector3d middle;
    double half_length;
  };

  std::vector<Axis> axes_;
  std::size_t last_ = 0;
};

}  // namespace tanglebin
