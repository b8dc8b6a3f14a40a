#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// n + 1 distinct colours for a scene of n tubes: entry 0 is the bin's grey, entry i the colour of tube i
/// (paper, Section 3: "(n + 1) different colors"). The same n always gives the same colours, and none is
/// null_color. Throws InputError for n < 0 and for more than a million tubes.
std::vector<Color> label_colors(int tubes);

/// Black, the colour of the null label.
inline constexpr Color null_color{0, 0, 0};

/// Converts the colours of label_colors(tubes), and null_color, back to labels. Throws InputError naming
/// `file` and the point for any other colour.
std::vector<std::int32_t> labels_from_colors(const std::vector<Color>& colors, int tubes,
                                             const std::string& file);

/// The same cloud with these labels, one for each point. A cloud without colours, or with none but colours of
/// labels, gets those of its new labels; labels above a million share the colours of smaller ones. Any other
/// colours, such as a colour camera's, are kept.
PointCloud labelled(PointCloud cloud, std::vector<std::int32_t> labels);

}  // namespace tanglebin
