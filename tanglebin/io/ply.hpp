#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a PLY cloud: ascii, binary_little_endian or binary_big_endian. The element `vertex` has x, y, z
/// (float or double), in any order among other scalar properties. Optional: red, green, blue (uchar), `label`
/// (integer), nx ny nz (float or double), `intensity` (any type) and `mixed` (integer). Other elements and
/// properties are skipped. Points that are NaN or infinite are kept in place. The cloud is organized if
/// `obj_info num_cols` and `num_rows` say so. Strict: throws InputError with the file (`name`), the line of
/// the header or ascii body, the property, what was found and what was expected. Labels must be at least −1.
/// Uses memory only in proportion to the data in the stream, whatever the header says. The stream may be a
/// pipe.
PointCloud read_ply(std::istream& in, const std::string& name);
PointCloud read_ply(const std::filesystem::path& file);

/// Writes binary little-endian PLY: x y z float (m), then, if the cloud has them, nx ny nz float, red green
/// blue uchar, label int, intensity float and mixed uchar (docs/formats.md); of an organized cloud, its size
/// as obj_info. A comment says what `coordinates` they are. Throws std::invalid_argument as check_cloud().
/// The caller checks the stream.
void write_ply(std::ostream& out, const PointCloud& cloud,
               std::string_view coordinates = "metres, world frame");

}  // namespace tanglebin
