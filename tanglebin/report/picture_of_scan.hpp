#pragma once

#include <string>

#include "tanglebin/report/shading.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// The largest error, m along the ray, that has a colour of its own in picture_of_scan().
inline constexpr double largest_error_in_picture = 0.002;

/// What a sensor made of a scene, beside the ideal scan of it by the same camera: above ideal depth, ideal
/// labels and the signal-to-noise ratio; below measured depth, measured labels and the error of the range.
/// Depth gets darker from the nearest to the farthest pixel; labels have label_colors(); the signal goes from
/// dark blue (0) over green to yellow (the largest); errors from blue (too near) over white (none) to red
/// (too far). Pixels without a point are black. The window of the scans, scaled down to panels of at most 480
/// pixels. Throws InputError with `name` as palette() does, or for a scan that sees nothing.
Picture picture_of_scan(const Scan& ideal, const Scan& measured, const std::string& name);

}  // namespace tanglebin
