#pragma once

#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Steps of a depth image in a metre: one step is 0.1 mm.
inline constexpr double depth_scale = 10000;

/// What a label image holds where a pixel's ray met nothing.
inline constexpr int nothing_in_label_image = 65535;

/// The PNG file of a depth image: 16-bit grey, steps of 0.1 mm, rounded. 0 where nothing was measured or the
/// depth does not fit (the format holds up to 6.5535 m).
std::string depth_png(const DepthImage& image);

/// The PNG file of a label image: 16-bit grey, 0 the bin, 1..n the tubes, nothing_in_label_image for null.
/// Throws InputError for a label above 65534.
std::string label_png(const LabelImage& image);

/// The PNG file of a picture: 8 bits for each of red, green and blue, width * height pixels row by row.
std::string color_png(int width, int height, const std::vector<Color>& pixels);

/// What turns a depth image into points, as JSON (docs/formats.md): width, height and intrinsic_matrix as
/// Open3D's PinholeCameraIntrinsic reads them, depth_scale, and camera_to_world (rows).
std::string camera_json(const Camera& camera);

}  // namespace tanglebin
