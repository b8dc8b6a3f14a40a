#pragma once

#include <cstddef>
#include <limits>
#include <numbers>

namespace tanglebin {

inline constexpr std::size_t no_index = std::numeric_limits<std::size_t>::max();
inline constexpr double degree = std::numbers::pi / 180;  ///< rad
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tanglebin
