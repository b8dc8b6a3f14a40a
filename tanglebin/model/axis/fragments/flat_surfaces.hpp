#pragma once

#include <optional>
#include <vector>

#include "tanglebin/model/axis/fragments/surface_patches.hpp"
#include "tanglebin/model/scene/pixel_grid.hpp"

namespace tanglebin {

// Internal to the room.

/// Which patches are of flat surfaces, such as a table, a wall or the rim of a bin. The patches are those of
/// surface_patches() with this sampling. About a place, a surface is flat if what is seen of it within 1.5
/// radii bulges by less than a fifth of what a tube of this radius (m) would. At least `places_min` such
/// places, half a radius apart in the image, make a flat surface if they are in one plane. It also has the
/// patches between them, such as those that are seen through gaps between tubes.
std::vector<bool> are_flat(const std::vector<std::optional<Patch>>& patches, const PixelGrid& grid,
                           const PatchSampling& sampling, double radius, int places_min);

}  // namespace tanglebin
