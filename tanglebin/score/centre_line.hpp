#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// A point on a centre line.
struct Place {
  std::size_t node;  ///< it is on the edge from this node towards node 0, or at this node
  double depth;      ///< m, along the centre line to node 0
};

/// The centre line of a tube with at least one edge, for nearest points and distances along it.
class CentreLine {
public:
  explicit CentreLine(const Tube& tube);

  double radius() const { return radius_; }
  const std::vector<Capsule>& capsules() const { return capsules_; }

  /// True only if a point is farther away than this distance, m. Fast, but may return false even if it is.
  bool is_surely_beyond(double distance, const Eigen::Vector3d& point) const {
    return box_.squaredExteriorDistance(point) > distance * distance;
  }

  /// The place nearest to a point, and its distance from the point, m.
  struct Nearest {
    Place place;
    double distance;
  };
  Nearest nearest(const Eigen::Vector3d& point) const;

  /// The distance along the tube from one place to another, m.
  double way(const Place& a, const Place& b) const;

private:
  void hang_up();

  double radius_;
  std::vector<Capsule> capsules_;
  Eigen::AlignedBox3d box_;
  std::vector<Edge> edges_;
  // The tree with node 0 at the top. For each node: the next node up, the number of edges to the top, and
  // their length.
  std::vector<std::size_t> parents_;
  std::vector<std::size_t> levels_;
  std::vector<double> depths_;
};

}  // namespace tanglebin
