#pragma once

#include <cstdint>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {

// Internal to the room.

/// Largest distance, in pixels, of a pixel's rays from its centre.
double ray_margin(const Sensor& sensor);

/// The seeds of a scan's random numbers.
struct ScanSeeds {
  std::uint64_t scene;    ///< of the tubes' materials
  std::uint64_t scanner;  ///< of noise, drop-outs and calibration
};

/// Turns an ideal scan into what a sensor measures.
Scan measure(const Surfaces& surfaces, Scan ideal, const Sensor& sensor, const ScanSeeds& seeds);

}  // namespace tanglebin
