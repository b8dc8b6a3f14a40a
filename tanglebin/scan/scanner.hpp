#pragma once

#include <cstdint>
#include <vector>

#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

/// The ideal scanner of the paper: one ray through each pixel's centre, no noise.
/// Only the pixels that can see the bin or a tube are traced.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera);

/// The same with the terms of a sensor that are switched on (docs/sensor.md); with none, the ideal scan. All
/// that is random follows from the seed, term by term and pixel by pixel. Throws InputError as
/// validate(sensor) does.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera, const Sensor& sensor,
          std::uint64_t seed);

}  // namespace tanglebin
