#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"

namespace tanglebin {

/// The ideal scanner of the paper: one ray through each pixel's centre, no noise.
/// Only the pixels that can see the bin or a tube are traced. Throws InputError as validate(camera) does.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera);

/// The same with the terms of a sensor that are switched on (docs/sensor.md); with none, the ideal scan. The
/// tubes' material follows from the scene's seed, so that several scanners of a scene see the same one; all
/// else that is random follows from the seed and the scanner's name, term by term and pixel by pixel. Throws
/// InputError as validate(camera) and validate(sensor) do.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner = "");

}  // namespace tanglebin
