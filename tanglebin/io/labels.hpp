#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Labels that an algorithm has given to a cloud's points: a cloud of all or some of these, or one label for
/// each, in the cloud's order.
using GivenLabels = std::variant<PointCloud, std::vector<std::int32_t>>;

/// Reads labels, whatever the file's name: a cloud as read_cloud() reads it, an NPY array of integers in one
/// dimension, or text with an integer on each line. Labels must be at least −1. Throws InputError naming file
/// (`name`), line or point, what was found and what was expected.
GivenLabels read_labels(std::istream& in, const std::string& name);
GivenLabels read_labels(const std::filesystem::path& file);

}  // namespace tanglebin
