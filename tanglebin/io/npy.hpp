#pragma once

#include "tanglebin/io/cloud_input.hpp"

// Internal to the room: NumPy's file format (numpy.lib.format), as far as images need it.
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

}  // namespace tanglebin
