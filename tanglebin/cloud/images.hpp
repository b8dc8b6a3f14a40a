#pragma once

#include <cstdint>
#include <vector>

namespace tanglebin {

/// Depths along the camera's z axis, row by row.
struct DepthImage {
  int width;
  int height;
  std::vector<float> depths;  ///< m; NaN if nothing was measured
};

/// Labels, row by row (geometry/labels.hpp).
struct LabelImage {
  int width;
  int height;
  std::vector<std::int32_t> labels;
};

}  // namespace tanglebin
