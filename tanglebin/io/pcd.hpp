#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a PCD cloud, version 0.7 (and 0.6): ascii, binary or binary_compressed; fields x, y, z (F 4 or 8) in
/// any order among others, optional `rgb`/`rgba` (packed, F 4 or U 4), `label` (I or U; PCL's invalid U 4
/// label is null), `normal_x` `normal_y` `normal_z` (F), `intensity` (any) and `mixed` (I or U). Strict as
/// read_ply(), but NaN points are kept, since organized clouds have them, and zeros that PCL leaves after
/// binary data are passed over. An identity VIEWPOINT counts as not known.
PointCloud read_pcd(std::istream& in, const std::string& name);
PointCloud read_pcd(const std::filesystem::path& file);

/// Writes PCD 0.7, binary_compressed, with WIDTH, HEIGHT and VIEWPOINT of the cloud, fields x y z rgb label
/// normal_x normal_y normal_z intensity mixed as the cloud has them (docs/formats.md), so that
/// pcl::PointXYZRGBL takes it: label is U 4, null all ones. Points are in the world frame; VIEWPOINT is the
/// sensor's pose in it, the identity where not known. Throws std::invalid_argument as check_cloud(),
/// std::length_error for 4 GiB and more; the caller checks the stream.
void write_pcd(std::ostream& out, const PointCloud& cloud);

}  // namespace tanglebin
