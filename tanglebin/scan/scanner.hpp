#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"

namespace tanglebin {

/// Scans with the paper's ideal scanner: one ray through each pixel's centre, no noise. Traces only the
/// pixels that can see the bin or a tube. Throws InputError as validate(Tube) and validate(Camera) do.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera);

/// Scans with a sensor (docs/sensor.md); with no term on, this is the ideal scan. The tubes' materials depend
/// only on the scene's seed, so all scanners of a scene see the same ones. All other random numbers depend on
/// the seed and the scanner's name, separately for each term and pixel. Throws InputError as validate(Tube),
/// validate(Camera) and validate(Sensor) do.
Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner = "");

/// How far a plane reaches from its origin in the scans of it, along its x and y, m.
inline constexpr double scanned_plane = 10;

/// Scans of tubes in or on any support, of which the scanner sees a bin's boxes, a plane up to scanned_plane,
/// or nothing. The support is valid. Everything is in the world frame. Throws InputError as above.
Scan scan(const std::vector<Tube>& tubes, const Support& support, const Camera& camera);
Scan scan(const std::vector<Tube>& tubes, const Support& support, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner = "");

}  // namespace tanglebin
