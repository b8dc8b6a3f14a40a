#pragma once

#include <cstdint>
#include <vector>

#include "tanglebin/io/cloud_input.hpp"

// Internal to the room: NumPy's file format (numpy.lib.format), as far as images and labels need it.
namespace tanglebin {

/// The types of an image's values: '<u2', '<f4' and '<f8'.
enum class NpyType { uint16, float32, float64 };

/// What an NPY file holds: height · width values, row by row, little-endian.
struct NpyHeader {
  NpyType type;
  int width;
  int height;
};

/// Reads the header of an NPY file, version 1.0, 2.0 or 3.0; the values come next in `input`. Throws
/// InputError unless it declares a matrix of one of the types, in C order, of at most most_pixels
/// (io/grey_png.hpp).
NpyHeader read_npy_header(cloud_format::CloudInput& input);

/// Reads an NPY file of one of these versions that holds integers in one dimension: '<i4', '<i8', '<i2',
/// '|i1', '<u4', '<u2' or '|u1'. Throws InputError for anything else. Uses memory only in proportion to the
/// data in the file, whatever the header says.
std::vector<std::int64_t> read_npy_integers(cloud_format::CloudInput& input);

}  // namespace tanglebin
