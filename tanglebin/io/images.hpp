#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Depth image steps per metre: one step is 0.1 mm.
inline constexpr double depth_scale = 10000;

/// The largest depth in a depth image, m.
inline constexpr double deepest = 65535 / depth_scale;

/// Value in a label image for pixels whose ray hit nothing.
inline constexpr int nothing_in_label_image = 65535;

/// The PNG file of a depth image: 16-bit grey, in steps of 0.1 mm, rounded. 0 if nothing was measured or the
/// depth is above the format's maximum of 6.5535 m.
std::string depth_png(const DepthImage& image);

/// The PNG file of a label image: 16-bit grey, with 0 = bin, 1..n = tubes, and nothing_in_label_image for
/// null. Throws InputError for a label above 65534.
std::string label_png(const LabelImage& image);

/// The PNG file of a mask: 8-bit grey, width * height values, row by row.
std::string mask_png(int width, int height, const std::vector<std::uint8_t>& values);

/// The PNG file of a colour picture: 8 bits per channel, width * height pixels, row by row.
std::string color_png(int width, int height, const std::vector<Color>& pixels);

/// JSON with the data needed to turn a depth image into points (docs/formats.md): width, height and
/// intrinsic_matrix as in Open3D's PinholeCameraIntrinsic, depth_scale, and camera_to_world (rows).
std::string camera_json(const Camera& camera);

}  // namespace tanglebin
