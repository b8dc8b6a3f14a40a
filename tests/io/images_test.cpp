#include "tanglebin/io/images.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct DecodedImage {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bit_depth = 0;
  int color_type = 0;
  std::vector<std::vector<png_byte>> rows;

  std::size_t channels() const { return color_type == PNG_COLOR_TYPE_RGB ? 3 : 1; }

  int sample(std::size_t u, std::size_t v, std::size_t channel = 0) const {
    const std::size_t index = u * channels() + channel;
    return bit_depth == 16 ? rows[v][2 * index] * 256 + rows[v][2 * index + 1] : rows[v][index];
  }
};

struct Source {
  const std::string* bytes;
  std::size_t position;
};

// libpng's errors are exceptions here: the process is a test, and they fail it.
[[noreturn]] void throw_error(png_structp /*png*/, png_const_charp message) {
  throw std::runtime_error(message);
}

DecodedImage decode(const std::string& bytes) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_error, throw_error);
  png_infop info = png_create_info_struct(png);
  Source source{&bytes, 0};
  png_set_read_fn(png, &source, [](png_structp reader, png_bytep data, std::size_t size) {
    auto& from = *static_cast<Source*>(png_get_io_ptr(reader));
    if (from.position + size > from.bytes->size()) png_error(reader, "cut off");
    from.position += from.bytes->copy(reinterpret_cast<char*>(data), size, from.position);
  });
  png_read_info(png, info);
  DecodedImage image;
  image.width = png_get_image_width(png, info);
  image.height = png_get_image_height(png, info);
  image.bit_depth = png_get_bit_depth(png, info);
  image.color_type = png_get_color_type(png, info);
  for (png_uint_32 row = 0; row < image.height; ++row) {
    image.rows.emplace_back(png_get_rowbytes(png, info));
    png_read_row(png, image.rows.back().data(), nullptr);
  }
  png_read_end(png, info);
  png_destroy_read_struct(&png, &info, nullptr);
  EXPECT_EQ(source.position, bytes.size());
  return image;
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A 3 x 2 image.
DepthImage depths_of(const std::vector<float>& depths) {
  return {3, 2, depths};
}

LabelImage labels_of(const std::vector<std::int32_t>& labels) {
  return {3, 2, labels};
}

TEST(DepthPng, HoldsTenthsOfMillimetresAndZeroForNothing) {
  const DecodedImage image = decode(depth_png(depths_of({1.98765F, 0.0001F, nan, 2.0F, 1.23454F, 0.5F})));
  EXPECT_EQ(image.width, 3U);
  EXPECT_EQ(image.height, 2U);
  EXPECT_EQ(image.bit_depth, 16);
  EXPECT_EQ(image.color_type, PNG_COLOR_TYPE_GRAY);
  EXPECT_EQ(image.sample(0, 0), 19877);  // rounded up
  EXPECT_EQ(image.sample(1, 0), 1);
  EXPECT_EQ(image.sample(2, 0), 0);
  EXPECT_EQ(image.sample(0, 1), 20000);
  EXPECT_EQ(image.sample(1, 1), 12345);  // rounded down
  EXPECT_EQ(image.sample(2, 1), 5000);
}

TEST(DepthPng, WhatSixteenBitsCannotHoldIsNoMeasurement) {
  const float infinity = std::numeric_limits<float>::infinity();
  const DecodedImage image = decode(depth_png(depths_of({6.5535F, 6.5537F, 100, infinity, -1, 1e30F})));
  EXPECT_EQ(image.sample(0, 0), 65535);
  EXPECT_EQ(image.sample(1, 0), 0);
  EXPECT_EQ(image.sample(2, 0), 0);
  EXPECT_EQ(image.sample(0, 1), 0);
  EXPECT_EQ(image.sample(1, 1), 0);
  EXPECT_EQ(image.sample(2, 1), 0);
}

TEST(LabelPng, HoldsLabelsAndAMarkForNothing) {
  const DecodedImage image = decode(label_png(labels_of({0, 1, null_label, 255, 256, 65534})));
  EXPECT_EQ(image.bit_depth, 16);
  EXPECT_EQ(image.color_type, PNG_COLOR_TYPE_GRAY);
  EXPECT_EQ(image.sample(0, 0), 0);
  EXPECT_EQ(image.sample(1, 0), 1);
  EXPECT_EQ(image.sample(2, 0), nothing_in_label_image);
  EXPECT_EQ(image.sample(0, 1), 255);
  EXPECT_EQ(image.sample(1, 1), 256);
  EXPECT_EQ(image.sample(2, 1), 65534);
}

TEST(LabelPng, RefusesALabelThatSixteenBitsCannotHold) {
  const LabelImage image = labels_of({65535, 0, 0, 0, 0, 0});
  try {
    label_png(image);
    FAIL() << "65535 was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("label 65535"));
  }
}

TEST(GreyPng, OfNothingIsAWholeEmptyImageInFewBytes) {
  const std::size_t pixels = std::size_t{1920} * 1200;
  const std::string depth = depth_png({1920, 1200, std::vector<float>(pixels, nan)});
  const DecodedImage depths = decode(depth);
  const DecodedImage labels = decode(label_png({1920, 1200, std::vector<std::int32_t>(pixels, null_label)}));
  EXPECT_EQ(depths.width, 1920U);
  EXPECT_EQ(depths.height, 1200U);
  EXPECT_LT(depth.size(), 100000U);
  for (std::size_t v = 0; v < 1200; ++v) {
    for (std::size_t u = 0; u < 1920; ++u) {
      ASSERT_EQ(depths.sample(u, v), 0);
      ASSERT_EQ(labels.sample(u, v), nothing_in_label_image);
    }
  }
}

TEST(GreyPng, TheSameImageGivesTheSameBytes) {
  const DepthImage depths = depths_of({1, 2, nan, 3, nan, nan});
  const LabelImage labels = labels_of({0, 1, null_label, 2, null_label, null_label});
  EXPECT_EQ(depth_png(depths), depth_png(depths));
  EXPECT_EQ(label_png(labels), label_png(labels));
}

TEST(ColorPng, HoldsEveryPixel) {
  const DecodedImage image =
      decode(color_png(2, 3, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {255, 254, 253}, {0, 0, 0}, {128, 127, 126}}));
  EXPECT_EQ(image.width, 2U);
  EXPECT_EQ(image.height, 3U);
  EXPECT_EQ(image.bit_depth, 8);
  EXPECT_EQ(image.color_type, PNG_COLOR_TYPE_RGB);
  EXPECT_EQ(image.sample(1, 0, 0), 4);
  EXPECT_EQ(image.sample(1, 1, 2), 253);
  EXPECT_EQ(image.sample(1, 2, 1), 127);
}

TEST(ColorPng, AnImageThatPngCannotHoldIsRefused) {
  EXPECT_THROW(color_png(0, 0, {}), InputError);
  EXPECT_THROW(color_png(2000000, 0, {}), InputError);
}

TEST(CameraJson, SaysHowADepthImageBecomesPoints) {
  Camera camera = camera_preset("paper");
  camera.cx += 3;
  const auto json = nlohmann::json::parse(camera_json(camera));
  EXPECT_EQ(json["width"], 1920);
  EXPECT_EQ(json["height"], 1200);
  EXPECT_EQ(json["depth_scale"], 10000.0);
  EXPECT_THAT(json["intrinsic_matrix"].get<std::vector<double>>(),  // column by column, as Open3D reads it
              ElementsAre(camera.fx, 0, 0, 0, camera.fy, 0, camera.cx, camera.cy, 1));
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(json["camera_to_world"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)],
                camera.pose.matrix()(row, column));
    }
  }
}

TEST(CameraJson, APointSurvivesTheWayThroughTheImage) {
  const Camera camera = camera_preset("paper");
  const auto json = nlohmann::json::parse(camera_json(camera));
  const auto k = json["intrinsic_matrix"].get<std::vector<double>>();
  const Eigen::Vector3d in_camera(0.1, -0.2, 1.9);
  const double u = k[0] * in_camera.x() / in_camera.z() + k[6];
  const double v = k[4] * in_camera.y() / in_camera.z() + k[7];
  const double steps = std::round(in_camera.z() * json["depth_scale"].get<double>());
  const double z = steps / json["depth_scale"].get<double>();
  const Eigen::Vector3d back((u - k[6]) / k[0] * z, (v - k[7]) / k[4] * z, z);
  EXPECT_TRUE(back.isApprox(in_camera, 1e-4));
  // The camera hangs 2 m above the floor, upside down: y and z turn round.
  EXPECT_TRUE((camera.pose * back).isApprox(Eigen::Vector3d(0.1, 0.2, 0.1), 1e-3));
}

}  // namespace
}  // namespace tanglebin
