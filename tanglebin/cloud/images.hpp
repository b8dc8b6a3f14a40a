#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// Depths along the camera's z axis, row by row.
struct DepthImage {
  int width;
  int height;
  std::vector<float> depths;                ///< m; NaN if nothing was measured
  std::optional<double> steps_per_metre{};  ///< of the integers that it was read from
};

/// The depth (m) if it is a measurement, a finite positive number; else NaN.
float measured_depth(float depth);

/// Labels, row by row (geometry/labels.hpp).
struct LabelImage {
  int width;
  int height;
  std::vector<std::int32_t> labels;
};

/// The organized cloud of a depth image: a point for each pixel, m, in the camera's frame, NaN where nothing
/// was measured: where the depth is not a finite positive number. Throws InputError unless the image has the
/// camera's size.
PointCloud cloud_from_depths(const DepthImage& image, const Intrinsics& intrinsics);

}  // namespace tanglebin
