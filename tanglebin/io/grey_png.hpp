#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

/// The most pixels of an image that is read: 8192 x 8192, as a camera may have.
inline constexpr std::size_t most_pixels = std::size_t{1} << 26U;

/// A grey image of 16 bits a pixel, row by row.
struct GreyImage {
  int width;
  int height;
  std::vector<std::uint16_t> values;
};

/// Decodes the bytes of a PNG file: 16-bit grey, without transparency. The values are those of the file,
/// whatever gamma or colour space it names. Throws InputError, naming the file `name`, for any other image, a
/// damaged one and one of more than most_pixels.
GreyImage grey_image_from_png(std::string_view png, const std::string& name);

}  // namespace tanglebin
