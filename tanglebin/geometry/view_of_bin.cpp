#include "tanglebin/geometry/view_of_bin.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Points = std::array<Vector3d, 8>;

// Of the box around the bin's walls and a heap that rises over the rim.
Points corners_in_camera(const Camera& camera, const Bin& bin) {
  const Vector3d half(bin.length / 2 + bin.wall, bin.width / 2 + bin.wall, bin.height);
  const Eigen::Isometry3d camera_from_world = camera.pose.inverse();
  Points corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d side((i & 1U) == 0 ? -1 : 1, (i & 2U) == 0 ? -1 : 1, (i & 4U) == 0 ? 0 : 2);
    corners[i] = camera_from_world * half.cwiseProduct(side).eval();
  }
  return corners;
}

// The normals, towards the view, of the five planes that bound it: its four sides, and the one through the
// camera's centre.
std::array<Vector3d, 5> sides_of_view(const Camera& camera) {
  const double left = -0.5 - camera.cx;
  const double right = camera.width - 0.5 - camera.cx;
  const double top = -0.5 - camera.cy;
  const double bottom = camera.height - 0.5 - camera.cy;
  return {Vector3d(camera.fx, 0, -left), Vector3d(-camera.fx, 0, right), Vector3d(0, camera.fy, -top),
          Vector3d(0, -camera.fy, bottom), Vector3d::UnitZ()};
}

std::string text_of(const Vector3d& vector) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", vector.x(), vector.y(), vector.z());
}

}  // namespace

void validate(const Camera& camera, const Bin& bin) {
  const Vector3d position = camera.pose.translation();
  const auto reject = [&](const std::string& expected) {
    throw InputError({"", 0, "scanner.position"},
                     fmt::format("a camera at {} m that looks along {}", text_of(position),
                                 text_of(camera.pose.linear().col(2))),
                     expected);
  };
  if (position.z() <= 0) reject("one above the bin's floor, z > 0");
  const Points corners = corners_in_camera(camera, bin);
  for (const Vector3d& inwards : sides_of_view(camera)) {
    const auto is_outside = [&](const Vector3d& corner) { return inwards.dot(corner) <= 0; };
    if (std::ranges::all_of(corners, is_outside)) reject("one that has the bin in its view");
  }
}

DepthRange depths_of(const Camera& camera, const Bin& bin) {
  const auto depth = [](const Vector3d& corner) { return corner.z(); };
  const Points corners = corners_in_camera(camera, bin);
  const auto [nearest, farthest] = std::ranges::minmax_element(corners, {}, depth);
  return {nearest->z(), farthest->z()};
}

}  // namespace tanglebin
