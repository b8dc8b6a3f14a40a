#pragma once

#include <array>
#include <string_view>

namespace tanglebin {

/// The names of a bin's parts in files, in the order of boxes().
inline constexpr std::array<std::string_view, 5> bin_part_names{"floor", "wall_min_x", "wall_max_x",
                                                                "wall_min_y", "wall_max_y"};

}  // namespace tanglebin
