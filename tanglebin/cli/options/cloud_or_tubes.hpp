#pragma once

#include <string>
#include <variant>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin::cli {

/// What a command can draw.
using CloudOrTubes = std::variant<PointCloud, std::vector<Tube>>;

/// Reads a cloud, a configuration or tubes.json, told apart by the first character; "-" is standard input.
/// Throws InputError naming the file.
CloudOrTubes read_cloud_or_tubes(const std::string& file);

}  // namespace tanglebin::cli
