#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// The colours of a scene of n tubes: n + 1 distinct ones, entry 0 the bin's grey, entry i tube i's (paper,
/// Section 3: "(n + 1) different colors"). The same for the same n; none is the null colour. Throws
/// InputError for n < 0 or more than a million tubes.
std::vector<Color> label_colors(int tubes);

/// Black: the null label's colour.
inline constexpr Color null_color{0, 0, 0};

/// The labels that label_colors(tubes) and null_color stand for. Throws InputError, naming `file` and the
/// point, for any other colour.
std::vector<std::int32_t> labels_from_colors(const std::vector<Color>& colors, int tubes,
                                             const std::string& file);

}  // namespace tanglebin
