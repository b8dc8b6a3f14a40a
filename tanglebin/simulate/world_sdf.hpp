#pragma once

#include <iosfwd>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/settle/settle.hpp"

namespace tanglebin {

/// Writes an SDF 1.7 world (docs/formats.md) for Gazebo, classic 11 and new: the bin as a static model, a
/// depth camera, a light, and each tube as a model with one rigid link at its pose.
///
/// Gravity, friction and solver are those of `settle`, so the heap stays as it came to rest; as there, the
/// smaller friction of two touching solids applies. The tubes' ids must be 1, 2, … and distinct. A tube of
/// unknown mass (0) gets 1 kg per metre of its centre line, like the paper's tubes. SDF only has cameras with
/// square pixels and a centred principal point; of the focal lengths, the world gets fx. Throws InputError
/// as validate(Tube) does, and for a camera with a horizontal field of view below 0.1 rad, SDF's minimum.
void write_world(std::ostream& out, const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera,
                 const SettleSettings& settle);

}  // namespace tanglebin
