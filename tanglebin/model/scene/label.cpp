#include "tanglebin/model/scene/label.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

/// A piece of a tube's surface, with a box around all points near it.
struct Claim {
  std::int32_t label;
  Capsule capsule;
  Eigen::AlignedBox3d box;
};

std::vector<Claim> claims_of(const std::vector<Tube>& tubes, double distance_max) {
  std::vector<Claim> claims;
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      Eigen::AlignedBox3d box(capsule.a);
      box.extend(capsule.b);
      box.min().array() -= capsule.radius + distance_max;
      box.max().array() += capsule.radius + distance_max;
      claims.push_back({tube.id, capsule, box});
    }
  }
  return claims;
}

/// The claims by the cells of a grid that their boxes touch.
class ClaimGrid {
public:
  explicit ClaimGrid(const std::vector<Claim>& claims) {
    Eigen::Vector3d sizes = Eigen::Vector3d::Zero();
    for (const Claim& claim : claims) {
      bounds_.extend(claim.box);
      sizes += claim.box.sizes() / static_cast<double>(claims.size());
    }
    if (bounds_.isEmpty()) return;
    constexpr double most_cells = 1 << 16;
    cell_ = sizes.cwiseMax(std::cbrt(bounds_.volume() / most_cells));
    counts_ = (bounds_.sizes().cwiseQuotient(cell_)).cast<int>() + Eigen::Vector3i::Ones();
    cells_.resize(static_cast<std::size_t>(counts_.prod()));
    for (std::uint32_t i = 0; i < claims.size(); ++i) add(i, claims[i].box);
  }

  /// The claims whose boxes may contain a point, ascending.
  const std::vector<std::uint32_t>& around(const Eigen::Vector3d& point) const {
    static const std::vector<std::uint32_t> none;
    return bounds_.contains(point) ? cells_[index_of(cell_of(point))] : none;
  }

private:
  void add(std::uint32_t claim, const Eigen::AlignedBox3d& box) {
    const Eigen::Vector3i first = cell_of(box.min());
    const Eigen::Vector3i last = cell_of(box.max());
    Eigen::Vector3i cell;
    for (cell.z() = first.z(); cell.z() <= last.z(); ++cell.z()) {
      for (cell.y() = first.y(); cell.y() <= last.y(); ++cell.y()) {
        for (cell.x() = first.x(); cell.x() <= last.x(); ++cell.x()) cells_[index_of(cell)].push_back(claim);
      }
    }
  }

  // Rounds monotonically, so that a point in a box is in one of the box's cells.
  Eigen::Vector3i cell_of(const Eigen::Vector3d& point) const {
    return ((point - bounds_.min()).cwiseQuotient(cell_)).cast<int>();
  }

  std::size_t index_of(const Eigen::Vector3i& cell) const {
    return static_cast<std::size_t>((cell.z() * counts_.y() + cell.y()) * counts_.x() + cell.x());
  }

  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3d cell_;    // m, size of a cell
  Eigen::Vector3i counts_;  // of cells
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings) {
  const std::vector<Claim> claims = claims_of(tubes, settings.distance_max);
  const ClaimGrid grid(claims);
  std::vector<std::int32_t> labels(points.size(), null_label);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[points[i]].cast<double>();
    double nearest = settings.distance_max;
    for (const std::uint32_t candidate : grid.around(point)) {
      const auto& [label, capsule, box] = claims[candidate];
      if (!box.contains(point)) continue;
      const double distance = std::abs(axis_distance(capsule, point) - capsule.radius);
      if (distance >= nearest) continue;
      nearest = distance;
      labels[i] = label;
    }
  }
  return labels;
}

std::vector<std::int32_t> label_points(const PointCloud& cloud, const Cropped& cropped,
                                       const std::vector<std::int32_t>& claimed,
                                       const std::vector<Tube>& tubes, const LabelSettings& settings) {
  std::vector<std::int32_t> labels(cloud.points.size(), null_label);
  for (const std::size_t point : cropped.support) labels[point] = bin_label;
  std::vector<std::size_t> rest;
  for (const std::size_t point : cropped.kept) {
    labels[point] = claimed[point];
    if (claimed[point] == null_label) rest.push_back(point);
  }
  const std::vector<std::int32_t> nearest = label_by_nearest(cloud, rest, tubes, settings);
  for (std::size_t i = 0; i < rest.size(); ++i) labels[rest[i]] = nearest[i];
  for (const std::size_t point : cropped.near) {
    if (labels[point] == null_label) labels[point] = bin_label;
  }
  return labels;
}

}  // namespace tanglebin
