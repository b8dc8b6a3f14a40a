#include "tanglebin/model/axis/fragments/axis_votes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "tanglebin/model/axis/fragments/flat_surfaces.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

using Boxes = std::vector<Eigen::AlignedBox3f>;

Boxes in_single_precision(const std::vector<Eigen::AlignedBox3d>& parts) {
  Boxes result;
  for (const auto& part : parts) result.push_back(part.cast<float>());
  return result;
}

bool is_clear_of(const Boxes& solid, const Vector3f& axis, float clearance) {
  return std::ranges::none_of(
      solid, [&](const auto& box) { return box.squaredExteriorDistance(axis) < clearance * clearance; });
}

std::vector<Vector3f> without_floor(std::vector<Vector3f> points, const Support& support, double margin) {
  if (support.shape == Support::Shape::nothing) return points;
  for (Vector3f& point : points) {
    if (point.z() < margin) point.setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return points;
}

}  // namespace

AxisVotes vote_for_axes(std::vector<Vector3f> points, const Support& support, const Camera& camera,
                        double radius, const VoteSettings& settings) {
  const Vector3f nothing = Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  AxisVotes result{std::vector(points.size(), nothing), std::vector(points.size(), nothing)};

  const auto depth = static_cast<float>(radius);  // of the axis below the surface
  const float clearance = std::max(
      0.0F, depth * (1 - static_cast<float>(settings.bin_tolerance)) - static_cast<float>(support.margin));
  const Boxes solid = in_single_precision(solid_parts(support));
  const PixelGrid grid(without_floor(std::move(points), support, settings.floor_margin * radius), camera);
  const PatchSampling sampling = suitable_sampling(grid, radius, settings.patch);
  const auto [reach, stride] = sampling;
  result.reach = reach;
  const std::vector<std::optional<Patch>> patches = surface_patches(grid, sampling, radius, settings.patch);
  const std::vector<bool> flat = holds_only_tubes(support)
                                     ? std::vector<bool>(patches.size())
                                     : are_flat(patches, grid, sampling, radius, settings.flat_min);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i]) continue;
    const Patch& patch = *patches[i];
    const std::size_t item = i * stride;
    // The plane lies below the surface by the mean sagitta of the neighbours' arc: their variance across the
    // tube, divided by its diameter.
    const float sagitta = patch.breadth * reach * reach / (2 * depth);
    const Vector3f axis = grid.point(item) + patch.mean - patch.normal * (depth - sagitta);
    if (!is_clear_of(solid, axis, clearance)) continue;
    const Vector3f to_sensor = (camera.pose.translation().cast<float>() - grid.point(item)).normalized();
    if (patch.normal.dot(to_sensor) < static_cast<float>(settings.facing_min)) continue;
    const std::size_t end = std::min(item + stride, grid.size());
    for (std::size_t near = item - std::min(item, stride - 1); near < end; ++near) {
      Vector3f& vote = result.votes[grid.indices()[near]];
      if (vote.allFinite() || (grid.point(near) - grid.point(item)).norm() > reach) continue;
      if (!flat[i]) vote = axis;
      result.normals[grid.indices()[near]] = patch.normal;
    }
  }
  return result;
}

}  // namespace tanglebin
