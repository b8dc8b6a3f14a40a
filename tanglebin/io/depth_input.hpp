#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Whether a file is a depth image, which its first byte tells: a PNG or NPY file. Takes nothing from the
/// stream.
bool is_depth_image(std::istream& in);

/// Reads a depth image: a PNG of 16-bit grey, or a NumPy array (NPY) of float32, float64 or uint16, one row
/// for each of the image's. A value is a depth along the camera's z axis. `steps_per_metre` of an image's
/// integers are a metre, and `floats_per_metre` of an image's floats. What is not a finite positive number is
/// nothing. Throws InputError with the file (`name`) for anything else, and uses memory only in proportion to
/// the data in the stream.
DepthImage read_depths(std::istream& in, const std::string& name,
                       std::optional<double> steps_per_metre = std::nullopt, double floats_per_metre = 1);
DepthImage read_depths(const std::filesystem::path& file,
                       std::optional<double> steps_per_metre = std::nullopt, double floats_per_metre = 1);

/// Reads a depth image as a cloud: read_depths(), then cloud_from_depths().
PointCloud read_depth_image(std::istream& in, const std::string& name, const Intrinsics& intrinsics,
                            std::optional<double> steps_per_metre = std::nullopt,
                            double floats_per_metre = 1);
PointCloud read_depth_image(const std::filesystem::path& file, const Intrinsics& intrinsics,
                            std::optional<double> steps_per_metre = std::nullopt,
                            double floats_per_metre = 1);

}  // namespace tanglebin
