#include "tanglebin/model/radius.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/filter.hpp"
#include "tanglebin/model/surface_patches.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

/// Patches of a grid's points, and how far they reach, m.
struct Surface {
  const PixelGrid& grid;
  float reach;
  std::vector<std::optional<Patch>> patches;
};

// What two patches say of the radius if they are on one cylinder. With p and q their middles and n and m
// their normals p − q = r (n − m), but for what is along the axis, to which the normals are square. Two
// corrections, each half of the variance across the tube over the radius: a patch's plane passes below the
// surface by the sagitta; and where the surface falls away from the sensor its points are denser on the near
// side, which tilts the plane farther than the surface at its middle.
std::optional<float> radius_of_pair(const Surface& surface, std::size_t first, std::size_t second,
                                    float distance_max) {
  constexpr float turn_min = 0.3F;  // rad, about
  const Patch& one = *surface.patches[first];
  const Patch& other = *surface.patches[second];
  const Vector3f way = surface.grid.point(first) + one.mean - surface.grid.point(second) - other.mean;
  const Vector3f turn = one.normal - other.normal;
  const float inner = way.dot(turn) / turn.squaredNorm();
  if (turn.norm() < turn_min || way.norm() > distance_max || inner <= 0) return std::nullopt;
  const float variance = (one.breadth + other.breadth) / 2 * surface.reach * surface.reach;
  return inner + variance / inner;
}

// Of all pairs that are so far apart (m) in the image, along rows and columns.
std::vector<float> radii_of_pairs(const Surface& surface, float distance) {
  constexpr float slope = 1.5F;  // points that are farther apart in depth are on two tubes
  const PixelGrid& grid = surface.grid;
  std::vector<float> radii;
  for (std::size_t item = 0; item < grid.size(); ++item) {
    if (!surface.patches[item]) continue;
    const auto [column, row] = grid.pixels()[item];
    const int across = static_cast<int>(std::ceil(grid.pixels_across(distance, grid.point(item))));
    for (const auto& [u, v] : {std::pair{column + across, row}, {column, row + across}}) {
      const PixelGrid::Run others = grid.run(v, u, u);
      const std::size_t end = others.first + static_cast<std::size_t>(others.size);
      for (std::size_t other = others.first; other < end; ++other) {
        if (!surface.patches[other]) continue;
        const auto radius = radius_of_pair(surface, item, other, slope * distance);
        if (radius) radii.push_back(*radius);
      }
    }
  }
  return radii;
}

}  // namespace

double estimate_radius(const PointCloud& cloud, const KnownScene& known, const std::string& name) {
  const PixelGrid grid(picked(cloud.points, crop(cloud, known.bin, {})), known.camera);
  const PatchSettings settings{.neighbours = 20, .reach_min = 0.25};
  // Patches of the right size need the radius: begin with a likely one.
  auto radius = static_cast<float>(KnownScene().radius);
  constexpr int refinements = 6;
  constexpr float pair_distance = 0.8F;
  constexpr std::size_t pairs_min = 100;
  for (int i = 0; i < refinements; ++i) {
    const float reach = suitable_reach(grid, radius, settings);
    std::vector<float> radii =
        radii_of_pairs({grid, reach, surface_patches(grid, reach, settings)}, pair_distance * radius);
    if (radii.size() < pairs_min) {
      throw InputError({name, 0, "radius"}, "too few points of a tube to estimate it from",
                       "a cloud that shows some, or the radius itself");
    }
    radius = median(std::move(radii));
  }
  return radius;
}

}  // namespace tanglebin
