#pragma once

#include <string>

#include "tanglebin/geometry/camera.hpp"

// Internal to the room: ROS's camera_info in YAML.
namespace tanglebin {

/// Reads the intrinsics of the rectified image. Throws InputError naming file, line and field for text that
/// is no camera_info, for a distorted image, and for one that is binned or cut out of a larger one.
Intrinsics read_camera_info(const std::string& text, const std::string& name);

}  // namespace tanglebin
