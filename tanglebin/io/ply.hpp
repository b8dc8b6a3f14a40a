#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "tanglebin/cloud/cloud.hpp"

namespace tanglebin {

/// Reads a PLY cloud: ascii, binary_little_endian or binary_big_endian; x, y, z float or double in any
/// order among other scalar properties of the element `vertex`; optional red, green, blue uchar, an
/// integer `label`, nx ny nz float or double, `intensity` of any type and an integer `mixed`; other elements
/// and properties are skipped. Strict: throws InputError with the file
/// (`name`), the line of the header or of the ascii body, the property, what was found and what was expected.
/// A coordinate that is not finite is an error, and so is a label below −1. Takes no more memory than the
/// stream has data for, whatever the header says; the stream may be a pipe.
PointCloud read_ply(std::istream& in, const std::string& name);
PointCloud read_ply(const std::filesystem::path& file);

/// Writes binary little-endian PLY: x y z float (m), then nx ny nz float, red green blue uchar, label int,
/// intensity float and mixed uchar where the cloud has them (docs/formats.md). Throws std::invalid_argument
/// as check_cloud(), and for a coordinate that is not finite; the caller checks the stream.
void write_ply(std::ostream& out, const PointCloud& cloud);

}  // namespace tanglebin
