#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// label_colors() for labels up to `largest_label`. Throws InputError with `name` if that is implausibly
/// large.
std::vector<Color> palette(std::int32_t largest_label, const std::string& name);

}  // namespace tanglebin
