#include "tanglebin/model/scene/label.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/scene/box_grid.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// A piece of a tube's surface, with a box around all points near it.
struct Claim {
  std::int32_t label;
  Capsule capsule;
  double distance_max;  // m
  Eigen::AlignedBox3d box;
};

std::vector<Claim> claims_of(const std::vector<Tube>& tubes, double distance_max) {
  std::vector<Claim> claims;
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      Claim claim{tube.id, capsule, distance_max * tube.radius, {}};
      claim.box.extend(claim.capsule.a);
      claim.box.extend(claim.capsule.b);
      claim.box.min().array() -= tube.radius + claim.distance_max;
      claim.box.max().array() += tube.radius + claim.distance_max;
      claims.push_back(claim);
    }
  }
  return claims;
}

BoxGrid grid_of(const std::vector<Claim>& claims) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(claims.size());
  for (const Claim& claim : claims) boxes.push_back(claim.box);
  return BoxGrid(boxes);
}

// From a cylinder that is cut flat, at the end that the point is nearer to.
double distance_from_cut(const Capsule& capsule, const Vector3d& end, const Vector3d& outward,
                         const Vector3d& point) {
  const double beyond = (point - end).dot(outward);
  const double aside = axis_distance(capsule, point - std::max(0.0, beyond) * outward) - capsule.radius;
  if (beyond >= 0) return std::hypot(beyond, std::max(0.0, aside));
  return aside >= 0 ? aside : std::min(-aside, -beyond);
}

double surface_distance_of(const Claim& claim, const Vector3d& point) {
  const auto& [a, b, radius, flat_at_a, flat_at_b] = claim.capsule;
  const bool is_nearer_to_b = nearest_on_axis(claim.capsule, point) > 0.5;
  const bool is_cut = is_nearer_to_b ? flat_at_b : flat_at_a;
  if (!is_cut || a == b) return std::abs(axis_distance(claim.capsule, point) - radius);
  const Vector3d along = (b - a).normalized();
  return is_nearer_to_b ? distance_from_cut(claim.capsule, b, along, point)
                        : distance_from_cut(claim.capsule, a, -along, point);
}

// At a point on a table that a tube lies on, within the reach of a label, the cosine is -0.5 or less.
bool faces(const Claim& claim, const Vector3d& point, const Vector3d& normal) {
  const auto& [a, b, radius, flat_at_a, flat_at_b] = claim.capsule;
  const Vector3d outwards = point - (a + nearest_on_axis(claim.capsule, point) * (b - a));
  constexpr double cosine_min = -0.35;
  return outwards.dot(normal) < cosine_min * outwards.norm();
}

double support_distance(const std::vector<Eigen::AlignedBox3d>& support, const Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::AlignedBox3d& part : support) nearest = std::min(nearest, part.exteriorDistance(point));
  return nearest;
}

}  // namespace

std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings,
                                           const OtherSurfaces& others) {
  const std::vector<Claim> claims = claims_of(tubes, settings.distance_max);
  const std::vector<Eigen::AlignedBox3d> support = solid_parts(others.support);
  const BoxGrid grid = grid_of(claims);
  std::vector<std::int32_t> labels(points.size(), null_label);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d point = cloud.points[points[i]].cast<double>();
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : grid.around(point)) {
      const Claim& claim = claims[index];
      if (!claim.box.contains(point)) continue;
      const double distance = surface_distance_of(claim, point);
      if (distance >= std::min(nearest, claim.distance_max)) continue;
      if (!others.normals.empty() && faces(claim, point, others.normals[points[i]].cast<double>())) continue;
      nearest = distance;
      labels[i] = claim.label;
    }
    if (labels[i] != null_label && support_distance(support, point) < nearest) labels[i] = null_label;
  }
  return labels;
}

std::vector<std::int32_t> label_points(const PointCloud& cloud, const Cropped& cropped,
                                       std::vector<std::int32_t> claimed, const std::vector<Tube>& tubes,
                                       const LabelSettings& settings, const OtherSurfaces& others) {
  std::vector<std::int32_t> labels = std::move(claimed);
  for (const std::size_t point : cropped.support) labels[point] = bin_label;
  std::vector<std::size_t> rest;
  std::ranges::copy_if(cropped.kept, std::back_inserter(rest),
                       [&](std::size_t point) { return labels[point] == null_label; });
  const std::vector<std::int32_t> nearest = label_by_nearest(cloud, rest, tubes, settings, others);
  for (std::size_t i = 0; i < rest.size(); ++i) labels[rest[i]] = nearest[i];
  for (const std::size_t point : cropped.near) {
    if (labels[point] == null_label) labels[point] = bin_label;
  }
  return labels;
}

}  // namespace tanglebin
