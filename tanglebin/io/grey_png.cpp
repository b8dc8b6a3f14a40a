#include "tanglebin/io/grey_png.hpp"

#include <fmt/core.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstddef>
#include <new>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/io/png_errors.hpp"

namespace tanglebin {
namespace {

static_assert(std::endian::native == std::endian::little, "what png_set_swap() is for");

// Deflate makes at most 258 bytes of two bits (RFC 1951).
constexpr std::size_t most_expansion = 1032;

struct Source {
  std::string_view rest;
  std::string error;
};

void take_bytes(png_structp png, png_bytep to, std::size_t size) {
  std::string_view& rest = static_cast<Source*>(png_get_io_ptr(png))->rest;
  if (size > rest.size()) png_error(png, "cut off");
  rest.copy(reinterpret_cast<char*>(to), size);
  rest.remove_prefix(size);
}

/// False if libpng jumped back.
bool read_header(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  return true;
}

/// The same.
bool read_rows(png_structp png, png_infop info, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return true;
}

/// libpng's two structures, destroyed together.
class PngReader {
public:
  explicit PngReader(Source& source)
      : png_(
            png_create_read_struct(PNG_LIBPNG_VER_STRING, &source.error, keep_png_error, ignore_png_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source, take_bytes);
    png_set_chunk_cache_max(png_, 1);  // keeps no texts
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

private:
  png_structp png_;
  png_infop info_;
};

std::string kind_of(int bit_depth, int color_type) {
  const std::string bits = fmt::format("{}-bit ", bit_depth);
  switch (color_type) {
    case PNG_COLOR_TYPE_GRAY:
      return bits + "grey";
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return bits + "grey with transparency";
    case PNG_COLOR_TYPE_PALETTE:
      return bits + "palette";
    default:
      return bits + "colour";
  }
}

void check_kind(const PngReader& reader, const std::string& name) {
  const int bit_depth = png_get_bit_depth(reader.png(), reader.info());
  const int color_type = png_get_color_type(reader.png(), reader.info());
  if (bit_depth == 16 && color_type == PNG_COLOR_TYPE_GRAY) return;
  throw InputError({name, 0, ""}, kind_of(bit_depth, color_type), "16-bit grey");
}

// So few bytes cannot hold so many pixels: a header alone must not be able to claim memory.
void check_size(std::size_t width, std::size_t height, std::size_t bytes, const std::string& name) {
  const std::string found = fmt::format("{} x {} pixels", width, height);
  if (width * height > most_pixels)
    throw InputError({name, 0, "size"}, found, fmt::format("at most {} pixels", most_pixels));
  if (2 * width * height > most_expansion * bytes)
    throw InputError({name, 0, "size"}, fmt::format("{} in {} bytes", found, bytes), "more bytes");
}

}  // namespace

GreyImage grey_image_from_png(std::string_view png, const std::string& name) {
  Source source{png, {}};
  const PngReader reader(source);
  const auto expect = [&](bool done) {
    if (!done) throw InputError({name, 0, ""}, "a damaged PNG image: " + printable(source.error));
  };
  expect(read_header(reader.png(), reader.info()));
  check_kind(reader, name);
  const std::size_t width = png_get_image_width(reader.png(), reader.info());
  const std::size_t height = png_get_image_height(reader.png(), reader.info());
  check_size(width, height, png.size(), name);

  GreyImage image{static_cast<int>(width), static_cast<int>(height),
                  std::vector<std::uint16_t>(width * height)};
  std::vector<png_bytep> rows(height);
  for (std::size_t row = 0; row < height; ++row)
    rows[row] = reinterpret_cast<png_bytep>(image.values.data() + row * width);
  expect(read_rows(reader.png(), reader.info(), rows));
  if (!source.rest.empty()) throw InputError({name, 0, ""}, "data after the end of the PNG image");
  return image;
}

}  // namespace tanglebin
