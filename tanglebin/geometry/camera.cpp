#include "tanglebin/geometry/camera.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>

#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/suggestion.hpp"
#include "tanglebin/geometry/rigid.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void require_pixels(int count, const char* field) {
  expect(count > 0, field, fmt::format("{}", count), "a positive number of pixels");
}

void require_focal_length(double pixels, const char* field) {
  expect(std::isfinite(pixels) && pixels > 0, field, fmt::format("{}", pixels),
         "a finite positive number of pixels");
}

/// Moved about the world's y axis, towards +x.
Camera tilted(Camera camera, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  camera.pose = Eigen::Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitY())) * camera.pose;
  return camera;
}

void require_coordinate(double pixels, const char* field) {
  expect(std::isfinite(pixels), field, fmt::format("{}", pixels), "a finite number of pixels");
}

}  // namespace

bool operator==(const Camera& camera, const Camera& other) {
  const auto numbers = [](const Camera& of) {
    return std::tuple(of.width, of.height, of.fx, of.fy, of.cx, of.cy);
  };
  return numbers(camera) == numbers(other) && camera.pose.matrix() == other.pose.matrix();
}

Camera downward_camera(int width, int height, double focal_length_px, const Vector3d& position) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal_length_px;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  // With z down and x along the world's x, the image's y is the world's −y.
  camera.pose.linear() = Vector3d(1, -1, -1).asDiagonal();
  camera.pose.translation() = position;
  return camera;
}

Intrinsics intrinsics_of(const Camera& camera) {
  return {camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy};
}

Camera camera_with(const Intrinsics& intrinsics, const Eigen::Isometry3d& pose) {
  const auto& [width, height, fx, fy, cx, cy] = intrinsics;
  return {.width = width, .height = height, .fx = fx, .fy = fy, .cx = cx, .cy = cy, .pose = pose};
}

double focal_length_from_hfov(int width, double hfov) {
  return width / (2 * std::tan(hfov / 2));
}

const std::vector<std::string_view>& scanner_presets() {
  static const std::vector<std::string_view> names{"paper", "gaussian", "zivid-one-plus-l", "kinect-v1",
                                                   "phoxi"};
  return names;
}

Camera camera_preset(std::string_view name) {
  constexpr int width = 1920;
  constexpr int height = 1200;
  const Vector3d position(0, 0, 2);
  if (name == "paper" || name == "gaussian") {
    return downward_camera(width, height, focal_length_from_hfov(width, 1.22), position);
  }
  if (name == "zivid-one-plus-l") return downward_camera(width, height, 2730, position);
  if (name == "kinect-v1") return downward_camera(640, 480, 585, Vector3d(0, 0, 1));
  if (name == "phoxi") return tilted(downward_camera(2064, 1544, 2430, Vector3d(0, 0, 1.2)), 11.9);
  reject_name(name, scanner_presets());
}

Ray ray_through(const Camera& camera, double u, double v) {
  const Vector3d direction((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
  return {camera.pose.translation(), (camera.pose.linear() * direction).normalized()};
}

std::optional<Vector2d> project(const Camera& camera, const Vector3d& point) {
  const Vector3d p = camera.pose.linear().transpose() * (point - camera.pose.translation());
  if (p.z() <= 0) return std::nullopt;
  return Vector2d(camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy);
}

std::optional<PixelPosition> pixel_of(const Camera& camera, const Vector3d& point) {
  const std::optional<SeenPixel> seen = seen_pixel(camera, point);
  return seen ? std::optional(seen->pixel) : std::nullopt;
}

double depth_of(const Camera& camera, const Vector3d& point) {
  return camera.pose.linear().col(2).dot(point - camera.pose.translation());
}

void validate(const Camera& camera) {
  require_pixels(camera.width, "scanner.width");
  require_pixels(camera.height, "scanner.height");
  constexpr std::int64_t most_pixels = std::int64_t{1} << 26;
  expect(std::int64_t{camera.width} * camera.height <= most_pixels, "scanner.width",
         std::to_string(camera.width) + " x " + std::to_string(camera.height) + " pixels",
         "an image of at most 67108864 pixels (8192 x 8192)");
  require_focal_length(camera.fx, "scanner.fx");
  require_focal_length(camera.fy, "scanner.fy");
  require_coordinate(camera.cx, "scanner.cx");
  require_coordinate(camera.cy, "scanner.cy");
  expect(camera.pose.translation().allFinite(), "scanner.pose", "a position that is not finite",
         "finite coordinates");
  expect(is_rigid(camera.pose), "scanner.pose", "an orientation that is not a rotation",
         "a right-handed orthonormal frame");
}

}  // namespace tanglebin
