#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a PCD cloud, version 0.7 (and 0.6): ascii, binary or binary_compressed; fields x, y, z (F 4 or 8) in
/// any order among others, optional `rgb`/`rgba` (packed, F 4 or U 4) and `label` (integer). Strict as
/// read_ply, but NaN points are kept, since organized clouds have them.
PointCloud read_pcd(std::istream& in, const std::string& name);
PointCloud read_pcd(const std::filesystem::path& file);

/// Writes PCD 0.7, binary_compressed, with WIDTH, HEIGHT and VIEWPOINT of the cloud, fields x y z rgb label
/// as the cloud has them. Points are in the world frame; VIEWPOINT is the sensor's pose in it.
void write_pcd(std::ostream& out, const PointCloud& cloud);

}  // namespace tanglebin
