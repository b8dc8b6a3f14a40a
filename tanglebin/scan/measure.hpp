#pragma once

#include <cstdint>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {

// Internal to the room.

/// What a sensor makes of what an ideal scanner sees.
Scan measure(const Surfaces& surfaces, Scan ideal, const Sensor& sensor, std::uint64_t seed);

}  // namespace tanglebin
