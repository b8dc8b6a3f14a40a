#pragma once

#include <string>

#include "tanglebin/pictures/shading.hpp"
#include "tanglebin/scan/scan.hpp"

namespace tanglebin {

/// The error, m along the ray, at which the colour scale of picture_of_scan() ends.
inline constexpr double largest_error_in_picture = 0.002;

/// A sensor's scan, compared with an ideal scan by the same camera. Top row: ideal depth, ideal labels,
/// signal-to-noise ratio. Bottom row: measured depth, measured labels, range error. Depth darkens from the
/// nearest to the farthest pixel. Labels have label_colors(). The signal goes from dark blue (0) over green
/// to yellow (maximum), errors from blue (too near) over white (none) to red (too far). Pixels without a
/// point are black. Shows the window of the scans, scaled down to panels of at most 480 pixels. Throws
/// InputError with `name` as palette() does, or for a scan that sees nothing.
Picture picture_of_scan(const Scan& ideal, const Scan& measured, const std::string& name);

}  // namespace tanglebin
