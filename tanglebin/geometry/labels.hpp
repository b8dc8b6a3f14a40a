#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tanglebin {

inline constexpr std::int32_t bin_label = 0;    ///< the bin; tubes are 1, 2, …
inline constexpr std::int32_t null_label = -1;  ///< unlabelled; in a scan: the ray hit nothing

/// Whether a point with one of these labels is on a tube.
inline bool has_tube(const std::vector<std::int32_t>& labels) {
  return std::ranges::any_of(labels, [](std::int32_t label) { return label > bin_label; });
}

}  // namespace tanglebin
