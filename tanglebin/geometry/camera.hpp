#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>
#include <vector>

#include "tanglebin/geometry/ray.hpp"

namespace tanglebin {

/// What a camera is by itself: the size of its images and its pinhole model (Camera has the conventions).
struct Intrinsics {
  int width;   ///< pixels
  int height;  ///< pixels
  double fx;   ///< focal lengths, pixels
  double fy;
  double cx;  ///< principal point, pixels
  double cy;

  bool operator==(const Intrinsics&) const = default;
};

/// A pinhole camera. The camera frame is the usual one in computer vision: x right, y down, z along the view.
/// The pixel in column u and row v has its centre at image coordinates (u, v); the image's centre is
/// ((width−1)/2, (height−1)/2).
struct Camera {
  int width = 1920;   ///< pixels
  int height = 1200;  ///< pixels
  double fx = 0.0;    ///< focal lengths, pixels
  double fy = 0.0;
  double cx = 0.0;  ///< principal point, pixels
  double cy = 0.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< camera frame → world frame
};

/// Whether all members are equal, bit for bit except for the sign of zeros.
bool operator==(const Camera& camera, const Camera& other);

/// A camera at `position` (m) that looks straight down. The image's x axis is along the world's x, pixels are
/// square, and the principal point is at the image's centre.
Camera downward_camera(int width, int height, double focal_length_px, const Eigen::Vector3d& position);

Intrinsics intrinsics_of(const Camera& camera);
Camera camera_with(const Intrinsics& intrinsics, const Eigen::Isometry3d& pose);

/// Focal length, in pixels, of an image that is `width` pixels wide and spans `hfov` radians, 0 < hfov < π.
double focal_length_from_hfov(int width, double hfov);

/// The names of the preset scanners.
const std::vector<std::string_view>& scanner_presets();

/// Pose and intrinsics of the preset scanners; sensor_preset() gives their errors. "paper", "gaussian": 1920
/// x 1200, 1.22 rad, 2 m above the floor (Section 6.1 and the published worlds). "zivid-one-plus-l": same
/// position and size, focal length 2730 px (38.7° x 24.8°). "kinect-v1": 640 x 480, focal length 585 px
/// (57.4° x 44.6°), 1 m above the floor. "phoxi": 2064 x 1544, focal length 2430 px (46.0° x 35.3°), 1.2 m
/// from the floor's centre, tilted by 11.9° towards +x. Throws InputError for any other name.
Camera camera_preset(std::string_view name);

/// The ray from the camera's centre through image coordinates (u, v).
Ray ray_through(const Camera& camera, double u, double v);

/// Image coordinates of a point (m, world frame), which may lie outside the image. None if the point is not
/// in front of the camera.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point);

/// A pixel of an image.
struct PixelPosition {
  int column;
  int row;
};

/// The pixel that a point (m, world frame) projects to. None if the point is not in the image.
std::optional<PixelPosition> pixel_of(const Camera& camera, const Eigen::Vector3d& point);

/// Depth of a point (m, world frame) along the camera's z axis, m.
double depth_of(const Camera& camera, const Eigen::Vector3d& point);

/// A pixel, and the depth (m) of the point that projects to it.
struct SeenPixel {
  PixelPosition pixel;
  double depth;
};

/// pixel_of() and depth_of() at once, inline: for many points.
inline std::optional<SeenPixel> seen_pixel(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = camera.pose.linear().transpose() * (point - camera.pose.translation());
  if (!(p.z() > 0)) return std::nullopt;
  // A pixel extends half a pixel to each side of its centre.
  const double u = camera.fx * p.x() / p.z() + camera.cx + 0.5;
  const double v = camera.fy * p.y() / p.z() + camera.cy + 0.5;
  const bool is_inside = u >= 0 && v >= 0 && u < camera.width && v < camera.height;
  if (!is_inside) return std::nullopt;
  return SeenPixel{{static_cast<int>(u), static_cast<int>(v)}, p.z()};
}

/// Throws InputError naming the invalid field under `scanner`.
void validate(const Camera& camera);

}  // namespace tanglebin
