#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// The points of a cloud by where they are: ascending indices. Points without a finite position are in none.
struct Cropped {
  std::vector<std::size_t> kept;     ///< around the support, and not the support itself
  std::vector<std::size_t> support;  ///< on the plane, or on the bin's floor or walls
  std::vector<std::size_t> outside;  ///< too far from the support
  std::vector<std::size_t> near{};   ///< of those kept, the ones within the support's margin
};

/// The box, m, in the support's frame, around the points that crop() keeps.
Eigen::AlignedBox3d crop_box(const Support& support, double overhang);

/// Sorts the points (m, in the support's frame) by the known support. The crop box follows the floor and
/// walls of a bin; tubes may stick out over its rim. Above a plane and without a support, only what is more
/// than 20 m from the origin is cropped.
Cropped crop(const PointCloud& cloud, const Support& support, const FilterSettings& settings);

/// Draws ratio · size of the indices (rounded) at random without replacement, and keeps their order.
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed);

/// Calls `see` with the index of each point that is left after downsampling, wherever it is: `filtered`,
/// which was drawn from `cropped.kept`, and the same ratio of the others.
template <typename See>
void for_each_seen(const Cropped& cropped, const std::vector<std::size_t>& filtered, double ratio,
                   std::uint64_t seed, const See& see) {
  std::ranges::for_each(filtered, see);
  for (const auto* others : {&cropped.support, &cropped.outside}) {
    if (ratio == 1)
      std::ranges::for_each(*others, see);
    else
      std::ranges::for_each(downsample(*others, ratio, seed), see);
  }
}

}  // namespace tanglebin
