#pragma once

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Throws InputError naming scanner.position if the camera is not above the plane of the bin's floor, or if
/// nothing of the bin and of a heap up to twice its height can be in the image. Both must be valid.
void validate(const Camera& camera, const Bin& bin);

/// Along the camera's axis, m.
struct DepthRange {
  double nearest;
  double farthest;
};

/// Where the bin and a heap up to twice its height are.
DepthRange depths_of(const Camera& camera, const Bin& bin);

}  // namespace tanglebin
