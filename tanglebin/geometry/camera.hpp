#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>

#include "tanglebin/geometry/ray.hpp"

namespace tanglebin {

/// A pinhole camera. Camera frame as in computer vision: x right, y down, z along the view. The centre of the
/// pixel in column u and row v has image coordinates (u, v); the image's centre is ((width−1)/2,
/// (height−1)/2).
struct Camera {
  int width = 1920;   ///< pixels
  int height = 1200;  ///< pixels
  double fx = 0.0;    ///< focal lengths, pixels
  double fy = 0.0;
  double cx = 0.0;  ///< principal point, pixels
  double cy = 0.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< camera frame → world frame
};

/// Are all members equal, bit for bit but for the sign of zeros?
bool operator==(const Camera& camera, const Camera& other);

/// A camera at `position` (m) that looks straight down, the image's x along the world's x, with square pixels
/// and the principal point at the image's centre.
Camera downward_camera(int width, int height, double focal_length_px, const Eigen::Vector3d& position);

/// Focal length in pixels of an image `width` pixels wide that spans `hfov` radians, 0 < hfov < π.
double focal_length_from_hfov(int width, double hfov);

/// Where each of the scanners stands and how it sees; sensor_preset() tells what it makes of it.
/// "paper", "gaussian": 1920 x 1200, 1.22 rad, 2 m above the floor (Section 6.1 and the published worlds).
/// "zivid-one-plus-l": the same place and size, focal length 2730 px (38.7° x 24.8°).
/// "kinect-v1": 640 x 480, focal length 585 px (57.4° x 44.6°), 1 m above the floor.
/// Throws InputError for another name.
Camera camera_preset(std::string_view name);

/// The ray from the camera's centre through image coordinates (u, v).
Ray ray_through(const Camera& camera, double u, double v);

/// Image coordinates of a point (m, world frame), also where they lie outside of the image; nothing for a
/// point that is not in front of the camera.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point);

/// A pixel of an image.
struct PixelPosition {
  int column;
  int row;
};

/// The pixel that a point (m, world frame) projects to; nothing for a point that is not in the image.
std::optional<PixelPosition> pixel_of(const Camera& camera, const Eigen::Vector3d& point);

/// How far a point (m, world frame) is in front of the camera, m, along its z axis.
double depth_of(const Camera& camera, const Eigen::Vector3d& point);

/// Throws InputError naming the field under `scanner` that makes no camera.
void validate(const Camera& camera);

}  // namespace tanglebin
