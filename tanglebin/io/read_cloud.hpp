#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a cloud with read_ply() or read_pcd(), chosen by the first character. Never seeks, so it can read
/// pipes. Throws InputError if the input does not start like a PLY or PCD file.
PointCloud read_cloud(std::istream& in, const std::string& name);
PointCloud read_cloud(const std::filesystem::path& file);

}  // namespace tanglebin
