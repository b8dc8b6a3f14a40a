#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// The points of a cloud by where they are: ascending indices. Points without a finite position are in none.
struct Cropped {
  std::vector<std::size_t> kept;     ///< around the bin, and not the bin itself
  std::vector<std::size_t> bin;      ///< on the floor or the walls
  std::vector<std::size_t> outside;  ///< too far from the bin
};

/// Sorts the points by the known bin. The crop box follows the floor and walls. Nothing is cropped above the
/// rim, because tubes stick out over it.
Cropped crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings);

/// Draws ratio · size of the indices (rounded) at random without replacement, and keeps their order.
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed);

/// The positions, m, of the points that are left after downsampling, wherever they are: `filtered`, which was
/// drawn from `cropped.kept`, and the same ratio of the others.
std::vector<Eigen::Vector3f> points_seen(const PointCloud& cloud, const Cropped& cropped,
                                         const std::vector<std::size_t>& filtered, double ratio,
                                         std::uint64_t seed);

}  // namespace tanglebin
