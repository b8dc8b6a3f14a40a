#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Reads tubes from a configuration or from the JSON of tubes.json (docs/formats.md), told apart by the first
/// character. Of the JSON, only the tubes' shape; it must be of a known format, in metres and in the world
/// frame, and each tube a tree. Throws InputError with file and field, and the line of a configuration.
std::vector<Tube> read_tubes(std::istream& in, const std::string& name);
std::vector<Tube> read_tubes(const std::filesystem::path& file);

}  // namespace tanglebin
