#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a cloud with read_ply() or read_pcd(), whichever the first character calls for: never seeks, and so
/// reads pipes too. Throws InputError for anything else than the beginning of a PLY or PCD file.
PointCloud read_cloud(std::istream& in, const std::string& name);
PointCloud read_cloud(const std::filesystem::path& file);

}  // namespace tanglebin
