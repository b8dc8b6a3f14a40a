#include "tanglebin/io/depth_input.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <istream>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"
#include "tanglebin/io/grey_png.hpp"
#include "tanglebin/io/npy.hpp"

namespace tanglebin {
namespace {

using cloud_format::CloudInput;

static_assert(std::endian::native == std::endian::little, "the files' byte order");

constexpr char first_of_png = '\x89';
constexpr char first_of_npy = '\x93';

// The first byte, or none of an empty file.
std::optional<char> first_byte(std::istream& in) {
  const auto first = in.peek();
  if (first == std::istream::traits_type::eof()) return std::nullopt;
  return std::istream::traits_type::to_char_type(first);
}

void check_steps(std::optional<double> steps_per_metre, const std::string& name) {
  if (!steps_per_metre || (std::isfinite(*steps_per_metre) && *steps_per_metre > 0)) return;
  throw InputError({name, 0, "steps per metre"}, fmt::format("{}", *steps_per_metre), "a positive number");
}

// Integers do not say what they count.
double steps_of_integers(std::optional<double> steps_per_metre, const std::string& name) {
  if (steps_per_metre) return *steps_per_metre;
  throw InputError({name, 0, "steps per metre"}, "nothing",
                   "how many steps of the image's integers are a metre: 1000 for millimetres");
}

float depth_of(double value, double steps_per_metre) {
  return measured_depth(static_cast<float>(value / steps_per_metre));
}

DepthImage read_png(std::istream& in, const std::string& name, std::optional<double> steps_per_metre) {
  constexpr std::size_t most_bytes = 4 * most_pixels;  // twice what they take uncompressed
  const GreyImage image = grey_image_from_png(read_bytes(in, name, most_bytes), name);
  const double steps = steps_of_integers(steps_per_metre, name);
  DepthImage depths{image.width, image.height, {}, steps};
  depths.depths.reserve(image.values.size());
  for (const std::uint16_t value : image.values) depths.depths.push_back(depth_of(value, steps));
  return depths;
}

// Reads piece by piece, so that a header alone cannot claim memory.
template <typename Value>
std::vector<float> read_values(CloudInput& input, std::size_t size, double steps_per_metre) {
  constexpr std::size_t piece = 1U << 14U;
  std::vector<Value> values(std::min(piece, size));
  std::vector<float> depths;
  depths.reserve(std::min(size, input.remaining() / sizeof(Value)));
  while (depths.size() < size) {
    const std::size_t wanted = std::min(piece, size - depths.size());
    const std::size_t bytes = input.read(reinterpret_cast<std::byte*>(values.data()), wanted * sizeof(Value));
    if (bytes < wanted * sizeof(Value)) {
      throw InputError(
          input.place_in_file(),
          fmt::format("{} values before the end of the file", depths.size() + bytes / sizeof(Value)),
          std::to_string(size));
    }
    for (std::size_t i = 0; i < wanted; ++i)
      depths.push_back(depth_of(static_cast<double>(values[i]), steps_per_metre));
  }
  if (!input.at_end()) throw InputError(input.place_in_file(), "data after the last value");
  return depths;
}

DepthImage read_npy(std::istream& in, const std::string& name, std::optional<double> steps_per_metre,
                    double floats_per_metre) {
  CloudInput input(in, name);
  const auto [type, width, height] = read_npy_header(input);
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  switch (type) {
    case NpyType::uint16: {
      const double steps = steps_of_integers(steps_per_metre, name);
      return {width, height, read_values<std::uint16_t>(input, size, steps), steps};
    }
    case NpyType::float32:
      return {width, height, read_values<float>(input, size, floats_per_metre)};
    case NpyType::float64:
      return {width, height, read_values<double>(input, size, floats_per_metre)};
  }
  return {};
}

}  // namespace

bool is_depth_image(std::istream& in) {
  const std::optional<char> first = first_byte(in);
  return first == first_of_png || first == first_of_npy;
}

DepthImage read_depths(std::istream& in, const std::string& name, std::optional<double> steps_per_metre,
                       double floats_per_metre) {
  check_steps(steps_per_metre, name);
  check_steps(floats_per_metre, name);
  const std::optional<char> first = first_byte(in);
  if (first == first_of_png) return read_png(in, name, steps_per_metre);
  if (first == first_of_npy) return read_npy(in, name, steps_per_metre, floats_per_metre);
  throw InputError({name, 0, ""}, first ? excerpt({&*first, 1}) + " at the start" : "an empty file",
                   "a depth image: a PNG or NPY file");
}

DepthImage read_depths(const std::filesystem::path& file, std::optional<double> steps_per_metre,
                       double floats_per_metre) {
  std::ifstream stream = open_input(file);
  return read_depths(stream, file.string(), steps_per_metre, floats_per_metre);
}

PointCloud read_depth_image(std::istream& in, const std::string& name, const Intrinsics& intrinsics,
                            std::optional<double> steps_per_metre, double floats_per_metre) {
  const DepthImage depths = read_depths(in, name, steps_per_metre, floats_per_metre);
  return with_file(name, [&] { return cloud_from_depths(depths, intrinsics); });
}

PointCloud read_depth_image(const std::filesystem::path& file, const Intrinsics& intrinsics,
                            std::optional<double> steps_per_metre, double floats_per_metre) {
  std::ifstream stream = open_input(file);
  return read_depth_image(stream, file.string(), intrinsics, steps_per_metre, floats_per_metre);
}

}  // namespace tanglebin
