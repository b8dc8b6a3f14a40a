#pragma once

#include <cstdint>

namespace tanglebin {

inline constexpr std::int32_t bin_label = 0;    ///< the bin; tubes are 1, 2, …
inline constexpr std::int32_t null_label = -1;  ///< unlabelled; in a scan: the ray hit nothing

}  // namespace tanglebin
