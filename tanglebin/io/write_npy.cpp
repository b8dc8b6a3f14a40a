#include "tanglebin/io/write_npy.hpp"

#include <bit>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace tanglebin {
namespace {

static_assert(std::endian::native == std::endian::little);

// A tuple of Python: "(3,)", "(1200, 1920)".
std::string tuple_text(const NpyShape& shape) {
  std::string text = "(";
  for (const std::size_t size : shape) text += std::to_string(size) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  return text + ")";
}

// Padded with blanks so that the values begin at a multiple of 64 bytes.
std::string header(std::string_view type, const NpyShape& shape) {
  constexpr std::size_t alignment = 64;
  constexpr std::string_view magic("\x93NUMPY\x01\x00", 8);
  std::string text =
      "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': " + tuple_text(shape) + ", }";
  const std::size_t before = magic.size() + sizeof(std::uint16_t);
  const std::size_t unpadded = before + text.size() + 1;
  text.append((alignment - unpadded % alignment) % alignment, ' ');
  text += '\n';
  const auto size = static_cast<std::uint16_t>(text.size());
  std::string bytes(magic);
  bytes += static_cast<char>(size & 0xffU);
  bytes += static_cast<char>(size >> 8U);
  return bytes + text;
}

template <typename Value>
std::string array_bytes(std::string_view type, const std::vector<Value>& values, const NpyShape& shape) {
  const std::size_t expected =
      std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  if (values.size() != expected)
    throw std::invalid_argument("npy_bytes: " + std::to_string(values.size()) + " values, expected " +
                                std::to_string(expected));
  std::string bytes = header(type, shape);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  return bytes;
}

}  // namespace

std::string npy_bytes(const std::vector<float>& values, const NpyShape& shape) {
  return array_bytes("<f4", values, shape);
}

std::string npy_bytes(const std::vector<double>& values, const NpyShape& shape) {
  return array_bytes("<f8", values, shape);
}

std::string npy_bytes(const std::vector<std::int32_t>& values, const NpyShape& shape) {
  return array_bytes("<i4", values, shape);
}

std::string npy_bytes(const std::vector<std::uint32_t>& values, const NpyShape& shape) {
  return array_bytes("<u4", values, shape);
}

}  // namespace tanglebin
