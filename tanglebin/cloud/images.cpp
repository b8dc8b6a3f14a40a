#include "tanglebin/cloud/images.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

void check_size(const DepthImage& image, const Intrinsics& camera) {
  if (image.width == camera.width && image.height == camera.height) return;
  const bool is_transposed = image.width == camera.height && image.height == camera.width;
  throw InputError({"", 0, "size"}, fmt::format("{} x {} pixels", image.width, image.height),
                   fmt::format("{} x {}, the size of the camera's image{}", camera.width, camera.height,
                               is_transposed ? "; is this one transposed?" : ""));
}

void expect_focal_length(const char* field, double pixels) {
  if (!std::isfinite(pixels) || pixels <= 0)
    throw InputError({"", 0, field}, fmt::format("{}", pixels), "a positive number of pixels");
}

// The coordinate, at depth 1, of the pixels of a row or a column.
std::vector<double> slopes(int pixels, double focal_length, double principal_point) {
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(pixels));
  for (int i = 0; i < pixels; ++i) result.push_back((i - principal_point) / focal_length);
  return result;
}

}  // namespace

float measured_depth(float depth) {
  return std::isfinite(depth) && depth > 0 ? depth : std::numeric_limits<float>::quiet_NaN();
}

PointCloud cloud_from_depths(const DepthImage& image, const Intrinsics& intrinsics) {
  check_size(image, intrinsics);
  expect_focal_length("fx", intrinsics.fx);
  expect_focal_length("fy", intrinsics.fy);
  const std::vector<double> across = slopes(image.width, intrinsics.fx, intrinsics.cx);
  const std::vector<double> down = slopes(image.height, intrinsics.fy, intrinsics.cy);
  PointCloud cloud;
  cloud.width = across.size();
  cloud.height = down.size();
  cloud.depth_scale = image.steps_per_metre;
  cloud.points.reserve(image.depths.size());
  for (std::size_t row = 0; row < cloud.height; ++row) {
    for (std::size_t column = 0; column < cloud.width; ++column) {
      const double depth = measured_depth(image.depths[row * cloud.width + column]);
      cloud.points.emplace_back(
          Eigen::Vector3d(across[column] * depth, down[row] * depth, depth).cast<float>());
    }
  }
  return cloud;
}

}  // namespace tanglebin
