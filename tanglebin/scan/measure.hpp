#pragma once

#include <cstdint>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {

// Internal to the room.

/// How far from a pixel's centre the rays are that it is measured by, in pixels.
double ray_margin(const Sensor& sensor);

/// What a scan's random numbers follow from.
struct ScanSeeds {
  std::uint64_t scene;    ///< the tubes' material
  std::uint64_t scanner;  ///< noise, drop-outs and calibration
};

/// What a sensor makes of what an ideal scanner sees.
Scan measure(const Surfaces& surfaces, Scan ideal, const Sensor& sensor, const ScanSeeds& seeds);

}  // namespace tanglebin
