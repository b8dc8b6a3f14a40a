#include "tanglebin/pictures/view.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/expect.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void require_near(const Vector3d& point, const std::string& name) {
  const double farthest = point.cwiseAbs().maxCoeff();
  if (!(farthest <= farthest_in_picture)) {
    throw InputError({.file = name, .line = 0, .field = "x y z"}, fmt::format("{:g} m", farthest),
                     fmt::format("coordinates within {:g} m", farthest_in_picture));
  }
}

void require_size(int pixels, const char* field) {
  expect(pixels >= 1 && pixels <= largest_picture, field, std::to_string(pixels),
         "1 to " + std::to_string(largest_picture) + " pixels");
}

/// Camera frame → world frame, for a viewer in this direction who looks at the scene, upright.
Matrix3d orientation(const View& view) {
  const double sin_azimuth = std::sin(view.azimuth);
  const double cos_azimuth = std::cos(view.azimuth);
  const double sin_elevation = std::sin(view.elevation);
  const double cos_elevation = std::cos(view.elevation);
  Matrix3d rotation;
  rotation.col(0) = Vector3d(-sin_azimuth, cos_azimuth, 0);
  rotation.col(1) = Vector3d(sin_elevation * cos_azimuth, sin_elevation * sin_azimuth, -cos_elevation);
  rotation.col(2) = Vector3d(-cos_elevation * cos_azimuth, -cos_elevation * sin_azimuth, -sin_elevation);
  return rotation;
}

}  // namespace

void validate(const View& view) {
  expect(std::isfinite(view.azimuth), "azimuth", std::to_string(view.azimuth), "a finite angle");
  expect(std::abs(view.elevation) <= std::numbers::pi / 2, "elevation",
         fmt::format("{:g}°", view.elevation * 180 / std::numbers::pi), "-90° to 90°");
  require_size(view.width, "width");
  require_size(view.height, "height");
}

Camera camera_for(const View& view, int scale, const std::vector<Vector3d>& points, const std::string& name) {
  for (const Vector3d& point : points) require_near(point, name);

  // Field of view of about 37° along the longer side: some perspective, but no wide-angle look.
  constexpr double focal_length = 1.5;  // in units of the longer side
  constexpr double used = 0.94;         // of the image; the rest is a margin
  constexpr double smallest_radius = 1e-6;

  const int width = scale * view.width;
  const int height = scale * view.height;
  const double focal_length_px = focal_length * std::max(width, height);
  const double slope_x = used * width / 2 / focal_length_px;
  const double slope_y = used * height / 2 / focal_length_px;

  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);

  // In a frame with the camera's orientation at the box's centre, a camera at (x, y, -distance) sees the
  // point p if |p.x - x| <= slope_x * (p.z + distance), and likewise for y. Each of these four bounds is set
  // by a single point.
  const Matrix3d rotation = orientation(view);
  constexpr double none = -std::numeric_limits<double>::infinity();
  double right = none;
  double left = none;
  double below = none;
  double above = none;
  for (const Vector3d& point : points) {
    const Vector3d p = rotation.transpose() * (point - box.center());
    right = std::max(right, p.x() - slope_x * p.z());
    left = std::max(left, -p.x() - slope_x * p.z());
    below = std::max(below, p.y() - slope_y * p.z());
    above = std::max(above, -p.y() - slope_y * p.z());
  }
  // Never so near that the camera is inside a flat scene seen from its edge.
  const double radius = std::max(box.diagonal().norm() / 2, smallest_radius);
  const double distance =
      std::max({1.5 * radius, (right + left) / (2 * slope_x), (below + above) / (2 * slope_y)});
  const Vector3d position((right - left) / 2, (below - above) / 2, -distance);
  Camera camera = downward_camera(width, height, focal_length_px, box.center() + rotation * position);
  camera.pose.linear() = rotation;
  return camera;
}

}  // namespace tanglebin
