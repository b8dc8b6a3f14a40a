#include "tanglebin/io/depth_input.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tanglebin/io/images.hpp"
#include "tests/cloud/clouds.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

DepthImage depths_in(const std::string& file, std::optional<double> steps_per_metre = std::nullopt,
                     double floats_per_metre = 1) {
  std::istringstream stream(file);
  return read_depths(stream, "depth", steps_per_metre, floats_per_metre);
}

std::string complaint_about(const std::string& file, std::optional<double> steps_per_metre = std::nullopt) {
  return complaint([&] { depths_in(file, steps_per_metre); });
}

// ---- NPY

template <typename Value>
std::string values(const std::vector<Value>& numbers) {
  std::string bytes;
  for (const Value number : numbers) bytes += bytes_of(number);
  return bytes;
}

std::string npy(const std::string& header, const std::string& body) {
  return "\x93NUMPY" + std::string("\x01\x00", 2) + bytes_of(static_cast<std::uint16_t>(header.size())) +
         header + body;
}

// As numpy.save() writes it.
std::string header_of(const std::string& descr, const std::string& shape = "(2, 3)") {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", descr, shape);
  header.append(127 - (header.size() + 10) % 64, ' ');
  return header + "\n";
}

const std::vector<float> six_depths{1.5F, 0.25F, 0, -1, nothing, std::numeric_limits<float>::infinity()};

TEST(ReadDepthNpy, OfFloatsHoldsMetres) {
  const DepthImage image = depths_in(npy(header_of("<f4"), values(six_depths)));
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.depths, ElementsAre(1.5F, 0.25F, IsNan(), IsNan(), IsNan(), IsNan()));
}

TEST(ReadDepthNpy, OfDoublesHoldsMetresToo) {
  const DepthImage image =
      depths_in(npy(header_of("<f8", "(1, 4)"), values<double>({1.25, 1e-60, 1e60, -0.0})));
  EXPECT_EQ(image.width, 4);
  EXPECT_THAT(image.depths, ElementsAre(1.25F, IsNan(), IsNan(), IsNan()));
}

TEST(ReadDepthNpy, OfAnotherUnitIsScaled) {
  EXPECT_THAT(depths_in(npy(header_of("<f4", "(1, 2)"), values<float>({1234.5F, 0})), 10000, 1000).depths,
              ElementsAre(1.2345F, IsNan()));
  EXPECT_THAT(
      depths_in(npy(header_of("<u2", "(1, 3)"), values<std::uint16_t>({1000, 0, 65535})), 1000).depths,
      ElementsAre(1, IsNan(), 65.535F));
}

TEST(ReadDepthNpy, OfEveryVersionIsRead) {
  const std::string header = header_of("<f4", "(1,1)");
  const std::string length = bytes_of(static_cast<std::uint32_t>(header.size()));
  for (const char* version : {"\x02", "\x03"}) {
    const std::string file = std::string("\x93NUMPY") + version + std::string(1, '\0') + length + header;
    EXPECT_THAT(depths_in(file + values<float>({2})).depths, ElementsAre(2));
  }
  EXPECT_EQ(complaint_about("\x93NUMPY" + std::string("\x04\x00", 2) + length),
            "depth: version: found 4.0, expected 1.0, 2.0 or 3.0");
}

TEST(ReadDepthNpy, MayHaveItsHeaderInAnyOrderAndQuotes) {
  const std::string header = R"({"shape":(1,1),"fortran_order":False,"descr":"<f4"})";
  EXPECT_THAT(depths_in(npy(header, values<float>({2}))).depths, ElementsAre(2));
}

TEST(ReadDepthNpy, SaysWhatIsWrongWithItsHeader) {
  const auto about = [](const std::string& header) { return complaint_about(npy(header, "")); };
  EXPECT_EQ(about("['descr']"), "depth: header: found '['descr']', expected {");
  EXPECT_EQ(about("{'descr' '<f4'}"), "depth: header: found ''<f4'}', expected :");
  EXPECT_EQ(about("{'descr': [('x', '<f4')]}"),
            "depth: header: found '[('x', '<f4')]}', expected the type of all values, such as '<f4'");
  EXPECT_EQ(about("{'descr': '<f4"),
            "depth: header: found ''<f4', expected the type of all values, such as '<f4'");
  EXPECT_EQ(about("{'fortran_order': 0}"), "depth: header: found '0}', expected True or False");
  EXPECT_EQ(about("{'shape': (2, -3)}"),
            "depth: header: found '-3)}', expected an integer from 0 to 4294967295");
  EXPECT_EQ(about("{'shape': 2}"), "depth: header: found '2}', expected (");
  EXPECT_EQ(about("{'shape': (2 3)}"), "depth: header: found '3)}', expected )");
  EXPECT_EQ(about("{'size': 3}"),
            "depth: header: found entry 'size', expected descr, fortran_order and shape");
  EXPECT_EQ(about("{'descr': '<f4', 'descr': '<f4'}"), "depth: header: found descr twice, expected it once");
  EXPECT_EQ(about("{'descr': '<f4'}}"), "depth: header: found '}', expected the end of the header");
  EXPECT_EQ(about("{'descr': '<f4'"), "depth: header: found its end, expected }");
  EXPECT_EQ(about("{}"), "depth: header: no entry descr");
  EXPECT_EQ(about("{'descr': '<f4'}"), "depth: header: no entry fortran_order");
  EXPECT_EQ(about("{'descr': '<f4', 'fortran_order': False}"), "depth: header: no entry shape");
}

TEST(ReadDepthNpy, SaysHowToConvertWhatItDoesNotRead) {
  EXPECT_EQ(complaint_about(npy(header_of(">f4"), "")),
            "depth: descr: found '>f4', expected '<f4', '<f8' or '<u2', little-endian; convert it: "
            "numpy.save(file, array.astype('<f4'))");
  EXPECT_EQ(complaint_about(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3)}", "")),
            "depth: fortran_order: found columns one after the other (Fortran order), expected rows; convert "
            "it: numpy.save(file, numpy.ascontiguousarray(array))");
}

TEST(ReadDepthNpy, OfAnotherShapeIsNoImage) {
  const auto about = [](const std::string& shape) {
    return complaint_about(npy(header_of("<f4", shape), ""));
  };
  EXPECT_EQ(about("()"), "depth: shape: found (), expected (rows, columns)");
  EXPECT_EQ(about("(7,)"), "depth: shape: found (7), expected (rows, columns)");
  EXPECT_EQ(about("(2, 3, 3)"), "depth: shape: found (2, 3, 3), expected (rows, columns)");
  EXPECT_EQ(about("(0, 3)"), "depth: shape: found (0, 3), expected an image of 1 to 67108864 pixels");
  EXPECT_EQ(about("(8193, 8192)"),
            "depth: shape: found (8193, 8192), expected an image of 1 to 67108864 pixels");
  EXPECT_EQ(about("(4294967295, 4294967295)"),
            "depth: shape: found (4294967295, 4294967295), expected an image of 1 to 67108864 pixels");
}

TEST(ReadDepthNpy, WithTooFewOrTooManyValuesIsRefused) {
  const std::string whole = npy(header_of("<f4"), values(six_depths));
  EXPECT_EQ(complaint_about(whole.substr(0, whole.size() - 1)),
            "depth: found 5 values before the end of the file, expected 6");
  EXPECT_EQ(complaint_about(whole + "x"), "depth: data after the last value");
  // Claims a quarter of a gigabyte; has none.
  EXPECT_EQ(complaint_about(npy(header_of("<f4", "(8192, 8192)"), "")),
            "depth: found 0 values before the end of the file, expected 67108864");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(complaint_about(whole.substr(0, size)), "none") << size << " bytes";
}

TEST(ReadDepthNpy, ReadsWhatNumpySaves) {
  const test::TemporaryDirectory directory;
  const auto python = [&](const std::string& program) {
    return test::run_shell("cd " + directory.path().string() + " && PATH=/usr/bin:/bin python3 -c '" +
                           program + "'");
  };
  if (python("import numpy").status != 0) GTEST_SKIP() << "python3-numpy is missing";
  const auto saved = python(R"(
import numpy
depths = numpy.array([[1.5, 0, 2], [numpy.nan, 0.25, numpy.inf]])
numpy.save("double.npy", depths)
numpy.save("float.npy", depths.astype("<f4"))
numpy.save("integer.npy", numpy.array([[1500, 0, 2000], [0, 250, 0]], "<u2"))
numpy.save("transposed.npy", depths.T)
)");
  ASSERT_EQ(saved.status, 0) << saved.err;
  const std::vector<std::pair<std::string, double>> files{
      {"double.npy", 1}, {"float.npy", 1}, {"integer.npy", 1000}};
  for (const auto& [name, steps] : files) {
    const DepthImage image = read_depths(directory / name, steps);
    EXPECT_EQ(image.width, 3) << name;
    EXPECT_EQ(image.height, 2) << name;
    EXPECT_THAT(image.depths, ElementsAre(1.5F, IsNan(), 2, IsNan(), 0.25F, IsNan())) << name;
  }
  EXPECT_THAT(complaint([&] { read_depths(directory / "transposed.npy"); }), HasSubstr("Fortran order"));
}

// ---- PNG

std::string png_of(const std::vector<float>& depths) {
  return depth_png({3, 2, depths});
}

struct PngKind {
  int bit_depth = 16;
  int color_type = PNG_COLOR_TYPE_GRAY;
  int interlace = PNG_INTERLACE_NONE;
  bool is_srgb = false;
};

// A picture of 3 x 2 pixels whose bytes are 0, 1, 2, …
std::string any_png(const PngKind& kind) {
  const auto fail = [](png_structp, png_const_charp message) { throw std::runtime_error(message); };
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  std::string bytes;
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<char*>(data), size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, 3, 2, kind.bit_depth, kind.color_type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (kind.is_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  const int passes = png_set_interlace_handling(png);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t row = 0; row < 2; ++row) {
      std::vector<png_byte> pixels(row_bytes);
      for (std::size_t i = 0; i < row_bytes; ++i) pixels[i] = static_cast<png_byte>(row * row_bytes + i);
      png_write_row(png, pixels.data());
    }
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST(ReadDepthPng, HoldsStepsAndZeroForNothing) {
  const DepthImage image = depths_in(png_of({1.5F, nothing, 0.0001F, 6.5535F, 2, nothing}), depth_scale);
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.depths, ElementsAre(1.5F, IsNan(), 0.0001F, 6.5535F, 2, IsNan()));
}

TEST(ReadDepthPng, ItsNumbersAreTakenAsTheyAre) {
  for (const bool is_srgb : {false, true}) {
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
      const DepthImage image = depths_in(any_png({.interlace = interlace, .is_srgb = is_srgb}), 1);
      EXPECT_THAT(image.depths, ElementsAre(0x0001, 0x0203, 0x0405, 0x0607, 0x0809, 0x0a0b));
    }
  }
}

TEST(ReadDepthPng, OfAnotherKindIsNoDepthImage) {
  EXPECT_EQ(complaint_about(any_png({.bit_depth = 8}), 1), "depth: found 8-bit grey, expected 16-bit grey");
  EXPECT_EQ(complaint_about(any_png({.color_type = PNG_COLOR_TYPE_GRAY_ALPHA}), 1),
            "depth: found 16-bit grey with transparency, expected 16-bit grey");
  EXPECT_EQ(complaint_about(color_png(1, 1, {{1, 2, 3}}), 1),
            "depth: found 8-bit colour, expected 16-bit grey");
}

TEST(ReadDepthPng, CutOrDamagedAnywhereIsRefused) {
  const std::string whole = png_of({1, 2, 3, 4, 5, 6});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(complaint_about(whole.substr(0, size), 1), "none") << size << " bytes";
  EXPECT_EQ(complaint_about(whole.substr(0, whole.size() - 1), 1), "depth: a damaged PNG image: cut off");
  EXPECT_EQ(complaint_about(whole + "x", 1), "depth: data after the end of the PNG image");
  std::string damaged = whole;
  damaged[45] ^= 1;
  EXPECT_THAT(complaint_about(damaged, 1), HasSubstr("a damaged PNG image"));
}

// Of a PNG chunk (ISO 15948, annex D).
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const char byte : bytes) {
    sum ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~sum;
}

TEST(ReadDepthPng, OfFewBytesCannotHoldManyPixels) {
  std::string claim = any_png({});
  // The header's width and height, and the checksum that goes with them.
  claim.replace(16, 8, std::string("\0\0\x20\0\0\0\x20\0", 8));
  const std::uint32_t sum = checksum(claim.substr(12, 17));
  for (int i = 0; i < 4; ++i)
    claim[29 + static_cast<std::size_t>(i)] = static_cast<char>(sum >> (24 - 8 * i));
  EXPECT_THAT(complaint_about(claim, 1), HasSubstr("size: found 8192 x 8192 pixels in "));
}

// ---- both

TEST(ReadDepths, IntegersNeedTheirScale) {
  const std::string expected =
      "depth: steps per metre: found nothing, expected how many steps of the image's integers are a metre: "
      "1000 for millimetres";
  EXPECT_EQ(complaint_about(png_of({1, 2, 3, 4, 5, 6})), expected);
  EXPECT_EQ(complaint_about(npy(header_of("<u2", "(1, 1)"), std::string(2, '\0'))), expected);
  EXPECT_EQ(complaint_about(png_of({1, 2, 3, 4, 5, 6}), 0),
            "depth: steps per metre: found 0, expected a positive number");
}

TEST(ReadDepths, RefusesEverythingElse) {
  EXPECT_EQ(complaint_about(""), "depth: found an empty file, expected a depth image: a PNG or NPY file");
  EXPECT_EQ(complaint_about("ply\n"),
            "depth: found 'p' at the start, expected a depth image: a PNG or NPY file");
  EXPECT_EQ(complaint([] { read_depths("no/such.png", 1); }),
            "no/such.png: cannot be opened: No such file or directory");
}

TEST(ReadDepths, KnowsADepthImageByItsFirstByte) {
  const auto is_image = [](const std::string& file) {
    std::istringstream stream(file);
    const bool answer = is_depth_image(stream);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), file);
    return answer;
  };
  EXPECT_TRUE(is_image(png_of({1, 2, 3, 4, 5, 6})));
  EXPECT_TRUE(is_image(npy(header_of("<f4"), values(six_depths))));
  EXPECT_FALSE(is_image("ply\n"));
  EXPECT_FALSE(is_image(""));
}

TEST(ReadDepthImage, GivesTheCloudThatTheCameraSaw) {
  const Intrinsics camera{.width = 3, .height = 2, .fx = 2, .fy = 4, .cx = 1, .cy = 0.5};
  const test::TemporaryDirectory directory;
  test::write_bytes(directory / "depth.png", png_of({1, 2, nothing, 0.5F, 3, 4}));
  const PointCloud cloud = read_depth_image(directory / "depth.png", camera, depth_scale);
  EXPECT_TRUE(same_properties(cloud, cloud_from_depths({3, 2, {1, 2, nothing, 0.5F, 3, 4}}, camera)));
  const Intrinsics other{.width = 2, .height = 2, .fx = 2, .fy = 4, .cx = 1, .cy = 0.5};
  EXPECT_THAT(complaint([&] { read_depth_image(directory / "depth.png", other, depth_scale); }),
              HasSubstr("depth.png: size: found 3 x 2 pixels, expected 2 x 2"));
}

}  // namespace
}  // namespace tanglebin
