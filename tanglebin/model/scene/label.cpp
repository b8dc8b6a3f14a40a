#include "tanglebin/model/scene/label.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/scene/box_grid.hpp"

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

BoxGrid grid_of(const std::vector<Claim>& claims) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Claim& claim : claims) boxes.push_back(claim.box);
  return BoxGrid(boxes);
}

}  // namespace

std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings) {
  const std::vector<Claim> claims = claims_of(tubes, settings.distance_max);
  const BoxGrid grid = grid_of(claims);
  std::vector<std::int32_t> labels(points.size(), null_label);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[points[i]].cast<double>();
    double nearest = settings.distance_max;
    for (const std::uint32_t claim : grid.around(point)) {
      const auto& [label, capsule, box] = claims[claim];
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
