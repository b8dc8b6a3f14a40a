#pragma once

#include <iosfwd>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/settle/settle.hpp"

namespace tanglebin {

/// Writes an SDF 1.7 world (docs/formats.md) that Gazebo, classic 11 and new, opens: the bin as a static
/// model, a depth camera, a light, and each tube as a model of one rigid link at its pose.
///
/// Gravity, friction and solver are those of `settle`, so the heap stays as it came to rest; as there, the
/// smaller friction of two solids that touch applies. The tubes' ids must be 1, 2, … and distinct. A tube of
/// unknown mass (0) gets 1 kg for each metre of its centre line, as the paper's tubes have. SDF knows only
/// cameras with square pixels and a centred principal point: of the focal lengths, the world has fx. Throws
/// InputError for a camera whose horizontal field of view is below 0.1 rad, the least that SDF allows.
void write_world(std::ostream& out, const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera,
                 const SettleSettings& settle);

}  // namespace tanglebin
