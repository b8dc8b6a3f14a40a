#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tanglebin {

/// The sizes of an array along its axes.
using NpyShape = std::vector<std::size_t>;

/// The bytes of an NPY file (numpy.lib.format, version 1.0): little-endian, C order. Throws
/// std::invalid_argument unless there are as many values as the shape says.
std::string npy_bytes(const std::vector<float>& values, const NpyShape& shape);
std::string npy_bytes(const std::vector<double>& values, const NpyShape& shape);
std::string npy_bytes(const std::vector<std::int32_t>& values, const NpyShape& shape);
std::string npy_bytes(const std::vector<std::uint32_t>& values, const NpyShape& shape);

}  // namespace tanglebin
