#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a PCD cloud, version 0.7 or 0.6: ascii, binary or binary_compressed. Fields x, y, z (F 4 or 8) may
/// be in any order among others. Optional fields: `rgb`/`rgba` (packed, F 4 or U 4), `label` (I or U; PCL's
/// invalid U 4 label is null), `normal_x` `normal_y` `normal_z` (F), `intensity` (any type) and `mixed` (I or
/// U). Keeps points that are NaN or infinite, and is as strict, as read_ply(), but skips the zeros that PCL
/// leaves after binary data. An identity VIEWPOINT means unknown.
PointCloud read_pcd(std::istream& in, const std::string& name);
PointCloud read_pcd(const std::filesystem::path& file);

/// Writes PCD 0.7, binary_compressed, with the cloud's WIDTH, HEIGHT and VIEWPOINT. Of the fields x y z rgb
/// label normal_x normal_y normal_z intensity mixed, writes those that the cloud has (docs/formats.md). label
/// is U 4, with all bits set for null, so that pcl::PointXYZRGBL can read it. Points are in the world frame;
/// VIEWPOINT is the sensor's pose in it, or the identity if unknown. Throws std::invalid_argument as
/// check_cloud(), and std::length_error from 4 GiB on. The caller checks the stream.
void write_pcd(std::ostream& out, const PointCloud& cloud);

}  // namespace tanglebin
