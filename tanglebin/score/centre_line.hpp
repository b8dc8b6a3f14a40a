#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// A point of a centre line.
struct Place {
  std::size_t node;  ///< it is on the edge from this node towards node 0, or that node itself
  double depth;      ///< m, the way to node 0
};

/// The centre line of a tube that has an edge at least: where a point is nearest to it, and ways along it.
class CentreLine {
public:
  explicit CentreLine(const Tube& tube);

  double radius() const { return radius_; }
  const std::vector<Capsule>& capsules() const { return capsules_; }

  /// Is a point farther away than a distance, m? Quick, and does not always know.
  bool is_surely_beyond(double distance, const Eigen::Vector3d& point) const {
    return box_.squaredExteriorDistance(point) > distance * distance;
  }

  /// The place that is nearest to a point, and how far it is away, m.
  struct Nearest {
    Place place;
    double distance;
  };
  Nearest nearest(const Eigen::Vector3d& point) const;

  /// The way along the tube from one place to another, m.
  double way(const Place& a, const Place& b) const;

private:
  void hang_up();

  double radius_;
  std::vector<Capsule> capsules_;
  Eigen::AlignedBox3d box_;
  std::vector<Edge> edges_;
  // The tree, hung up by node 0: of each node the next one up, how many edges it is down, and how long these
  // are.
  std::vector<std::size_t> parents_;
  std::vector<std::size_t> levels_;
  std::vector<double> depths_;
};

}  // namespace tanglebin
