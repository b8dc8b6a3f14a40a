#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// Reads a camera file: intrinsics, and the pose and the depth scale where the format has them. The format is
/// recognized by the contents (docs/formats.md): the JSON that `tanglebin scan --depth` writes; Open3D's
/// PinholeCameraIntrinsic and PinholeCameraParameters (JSON); BOP's camera.json and scene_camera.json; ROS's
/// camera_info, as camera_calibration_parsers writes it or as `ros2 topic echo` prints a CameraInfo (YAML).
/// `image` says which image of a scene_camera.json is meant; not needed if it has only one. Frame and unit
/// stay empty. Throws InputError for anything else, and for a distorted image of which only the camera
/// matrix is given. Where a camera_info has a projection matrix, it is the rectified image's camera.
SceneCamera read_camera_file(const std::filesystem::path& file, std::optional<int> image = {});

/// The same of text. `name` is for messages.
SceneCamera read_camera_text(const std::string& text, const std::string& name, std::optional<int> image = {});

}  // namespace tanglebin
