#include "tanglebin/model/axis/fragments/surface_radii.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace tanglebin {
namespace {

using Eigen::Vector3f;

/// The patches of a grid's points, and their reach, m.
struct Surface {
  const PixelGrid& grid;
  float reach;
  std::vector<std::optional<Patch>> patches;
};

// Let p and q be the middles of two patches and n and m their normals. Then p − q = r (n − m), except along
// the axis, to which the normals are perpendicular. There are two corrections, each half of the variance
// across the tube over the radius. A patch's plane lies below the surface by the sagitta. Where the surface
// falls away from the sensor, points are denser on the near side, which tilts the plane more than the surface
// at its middle.
std::optional<float> radius_of_pair(const Surface& surface, std::size_t first, std::size_t second,
                                    float distance_max) {
  constexpr float turn_min = 0.3F;  // rad, approximate
  const Patch& one = *surface.patches[first];
  const Patch& other = *surface.patches[second];
  const Vector3f way = surface.grid.point(first) + one.mean - surface.grid.point(second) - other.mean;
  const Vector3f turn = one.normal - other.normal;
  const float inner = way.dot(turn) / turn.squaredNorm();
  if (turn.norm() < turn_min || way.norm() > distance_max || inner <= 0) return std::nullopt;
  const float variance = (one.breadth + other.breadth) / 2 * surface.reach * surface.reach;
  return inner + variance / inner;
}

}  // namespace

std::vector<PairRadius> radii_of_pairs(const PixelGrid& grid, double radius, const PatchSettings& settings) {
  const float reach = suitable_sampling(grid, radius, settings).reach;
  const Surface surface{grid, reach, surface_patches(grid, {reach, 1}, radius, settings)};
  constexpr float share = 0.8F;
  constexpr float slope = 1.5F;  // points that differ more in depth are on two tubes
  const float distance = share * static_cast<float>(radius);
  std::vector<PairRadius> pairs;
  for (std::size_t item = 0; item < grid.size(); ++item) {
    if (!surface.patches[item]) continue;
    const auto [column, row] = grid.pixels()[item];
    const int across = static_cast<int>(std::ceil(grid.pixels_across(distance, grid.point(item))));
    for (const auto& [u, v] : {std::pair{column + across, row}, {column, row + across}}) {
      const PixelGrid::Run others = grid.window({u, v}, 0).row(v);
      const std::size_t end = others.first + others.size;
      for (std::size_t other = others.first; other < end; ++other) {
        if (!surface.patches[other]) continue;
        const auto found = radius_of_pair(surface, item, other, slope * distance);
        if (found) pairs.push_back({item, other, *found});
      }
    }
  }
  return pairs;
}

}  // namespace tanglebin
