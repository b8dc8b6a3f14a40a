#include "tanglebin/io/images.hpp"

#include <fmt/core.h>
#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/io/png_errors.hpp"

namespace tanglebin {
namespace {

/// An image as stored in PNG: row by row, two bytes per sample, high byte first.
struct RawImage {
  int width;
  int height;
  int bit_depth;
  int color_type;
  std::vector<png_byte> bytes;
};

struct Sink {
  std::string png;
  std::string error;
};

void append(png_structp png, png_bytep data, std::size_t size) noexcept {
  static_cast<Sink*>(png_get_io_ptr(png))->png.append(reinterpret_cast<const char*>(data), size);
}

void flush_nothing(png_structp /*png*/) noexcept {}

/// False if libpng jumped back.
bool write_image(png_structp png, png_infop info, const RawImage& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
               image.bit_depth, image.color_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 1);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  for (std::size_t offset = 0; offset < image.bytes.size(); offset += row_bytes) {
    png_write_row(png, image.bytes.data() + offset);
  }
  png_write_end(png, nullptr);
  return true;
}

/// libpng's two structures, destroyed together.
class PngWriter {
public:
  explicit PngWriter(Sink& sink)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink.error, keep_png_error, ignore_png_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, &sink, append, flush_nothing);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  bool write(const RawImage& image) const { return write_image(png_, info_, image); }

private:
  png_structp png_;
  png_infop info_;
};

std::string encode(const RawImage& image) {
  Sink sink;
  const PngWriter writer(sink);
  if (!writer.write(image)) throw InputError({.file = {}, .line = 0, .field = "image"}, sink.error);
  return std::move(sink.png);
}

template <typename Value, typename SampleOf>
std::string grey_png(int width, int height, const std::vector<Value>& values, SampleOf sample_of) {
  RawImage image{width, height, 16, PNG_COLOR_TYPE_GRAY, {}};
  image.bytes.reserve(2 * values.size());
  for (const Value value : values) {
    const std::uint16_t sample = sample_of(value);
    image.bytes.push_back(static_cast<png_byte>(sample >> 8U));
    image.bytes.push_back(static_cast<png_byte>(sample & 0xffU));
  }
  return encode(image);
}

std::uint16_t depth_sample(float depth) {
  const double steps = std::round(static_cast<double>(depth) * depth_scale);
  const bool fits = steps >= 0 && steps <= 65535;  // false for NaN
  return fits ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

std::uint16_t label_sample(std::int32_t label) {
  if (label == null_label) return nothing_in_label_image;
  if (label >= nothing_in_label_image) {
    throw InputError({.file = {}, .line = 0, .field = "label image"}, fmt::format("label {}", label),
                     fmt::format("at most {}, the largest in 16 bits", nothing_in_label_image - 1));
  }
  return static_cast<std::uint16_t>(label);
}

}  // namespace

std::string depth_png(const DepthImage& image) {
  return grey_png(image.width, image.height, image.depths, depth_sample);
}

std::string label_png(const LabelImage& image) {
  return grey_png(image.width, image.height, image.labels, label_sample);
}

std::string mask_png(int width, int height, const std::vector<std::uint8_t>& values) {
  return encode({width, height, 8, PNG_COLOR_TYPE_GRAY, values});
}

std::string color_png(int width, int height, const std::vector<Color>& pixels) {
  RawImage image{width, height, 8, PNG_COLOR_TYPE_RGB, {}};
  image.bytes.reserve(3 * pixels.size());
  for (const Color& color : pixels) image.bytes.insert(image.bytes.end(), color.begin(), color.end());
  return encode(image);
}

std::string camera_json(const Camera& camera) {
  const Eigen::Matrix4d pose = camera.pose.matrix();
  nlohmann::ordered_json json;
  json["width"] = camera.width;
  json["height"] = camera.height;
  json["intrinsic_matrix"] = {camera.fx, 0.0,       0.0,       0.0, camera.fy,
                              0.0,       camera.cx, camera.cy, 1.0};  // columns
  json["depth_scale"] = depth_scale;
  for (int row = 0; row < 4; ++row) {
    json["camera_to_world"].push_back({pose(row, 0), pose(row, 1), pose(row, 2), pose(row, 3)});
  }
  return json.dump(2) + "\n";
}

}  // namespace tanglebin
