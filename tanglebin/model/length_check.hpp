#pragma once

#include <vector>

#include "tanglebin/model/scene/finding.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

// Internal to the room.
namespace tanglebin {

/// Warnings if many tubes are longer or shorter than they are known to be, or look cut in two: where two that
/// are together too long for one end to end, in line. Lengths that were told and lengths that were estimated
/// have a warning each.
std::vector<Finding> doubts_of_lengths(const KnownScene& known, const Model& model);

}  // namespace tanglebin
