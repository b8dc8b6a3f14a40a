#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// What a scanner measured, and what is known about it.
struct Measurement {
  PointCloud cloud;
  Scene scene;
};

/// Reads a cloud with read_cloud(), about which the scene is all that is known; or a depth image with
/// read_depths(). That becomes an organized cloud in the camera's frame, in metres, as the scene returned
/// says; its integers count by the scene's depth scale, or else by its unit, and its floats by its unit, or
/// else in metres. Throws InputError as these do, and naming what the scene must say of the camera.
Measurement read_measurement(std::istream& in, const std::string& name, const Scene& scene);
Measurement read_measurement(const std::filesystem::path& file, const Scene& scene);

}  // namespace tanglebin
