#include "tanglebin/model/locate/sensor_view.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t points_min = 1000;

Vector3f nothing() {
  return Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
}

std::size_t index_of(const Camera& camera, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width) +
         static_cast<std::size_t>(column);
}

// OpenGL's camera frame has z backwards and y up.
std::string hint_of_behind(std::size_t finite, std::size_t behind) {
  if (10 * behind <= 9 * finite) return "";
  return " Nearly all are behind the camera: if z points backwards, as in OpenGL, write (x, −y, −z) for each "
         "point (x, y, z)";
}

void expect_points(std::size_t finite, std::size_t behind, std::size_t in_image) {
  const InputPlace place{.file = "", .line = 0, .field = "cloud"};
  if (finite < points_min) {
    throw InputError(place, fmt::format("{} points with a position", finite),
                     fmt::format("at least {} to locate the support", points_min));
  }
  if (2 * in_image < finite || in_image < points_min) {
    throw InputError(
        place,
        fmt::format(
            "{} of {} points in the camera's image: do frame, unit and camera belong to this cloud?{}",
            in_image, finite, hint_of_behind(finite, behind)),
        "most of them");
  }
}

// Whether hardly any of the pixels around has a point near this one's: it is no part of a surface.
bool is_speck(const SensorView& view, std::size_t pixel) {
  constexpr float step = 10;  // pixels: of a surface that is seen at a grazing angle
  constexpr int neighbours_min = 5;
  constexpr int near_min = 2;
  const auto width = static_cast<std::size_t>(view.camera.width);
  const int column = static_cast<int>(pixel % width);
  const int row = static_cast<int>(pixel / width);
  const float depth = view.points[pixel].z();
  const float tolerance = step * static_cast<float>(view.pixel_size(depth));
  int neighbours = 0;
  int near = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const float other = view.at(column + dx, row + dy).z();
      if ((dx == 0 && dy == 0) || std::isnan(other)) continue;
      ++neighbours;
      if (std::abs(other - depth) < tolerance) ++near;
    }
  }
  return neighbours >= neighbours_min && near < near_min;
}

void drop_specks(SensorView& view) {
  std::vector<std::size_t> specks;
  std::ranges::copy_if(view.seen, std::back_inserter(specks),
                       [&](std::size_t pixel) { return is_speck(view, pixel); });
  for (const std::size_t pixel : specks) view.points[pixel] = nothing();
  std::erase_if(view.seen, [&](std::size_t pixel) { return !view.points[pixel].allFinite(); });
}

}  // namespace

Vector3f SensorView::at(int column, int row) const {
  if (column < 0 || column >= camera.width || row < 0 || row >= camera.height) return nothing();
  return points[index_of(camera, column, row)];
}

std::vector<std::size_t> SensorView::sample(std::size_t count) const {
  // An odd stride does not fall into step with the image's rows.
  const std::size_t stride = (seen.size() / std::max<std::size_t>(count, 1)) | 1U;
  std::vector<std::size_t> chosen;
  chosen.reserve(seen.size() / stride + 1);
  for (std::size_t i = 0; i < seen.size(); i += stride) chosen.push_back(seen[i]);
  return chosen;
}

SensorView view_of(const PointCloud& cloud, const Camera& camera) {
  SensorView view{.camera = camera, .points = {}, .seen = {}};
  view.camera.pose.setIdentity();
  view.points.assign(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height),
                     nothing());
  const Isometry3d from_world = camera.pose.inverse(Eigen::Isometry);
  std::size_t finite = 0;
  std::size_t behind = 0;
  std::size_t in_image = 0;
  for (const Vector3f& point : cloud.points) {
    if (!point.allFinite()) continue;
    ++finite;
    const Vector3d in_camera = from_world * point.cast<double>();
    if (in_camera.z() < 0) ++behind;
    const std::optional<PixelPosition> pixel = pixel_of(view.camera, in_camera);
    if (!pixel) continue;
    ++in_image;
    Vector3f& nearest = view.points[index_of(camera, pixel->column, pixel->row)];
    if (!(nearest.z() <= in_camera.z())) nearest = in_camera.cast<float>();
  }
  expect_points(finite, behind, in_image);
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    if (view.points[i].allFinite()) view.seen.push_back(i);
  }
  drop_specks(view);
  return view;
}

}  // namespace tanglebin
