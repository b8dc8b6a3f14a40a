#include <algorithm>
#include <array>
#include <cmath>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/pictures/palette.hpp"
#include "tanglebin/pictures/picture.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

PointCloud finite_points(const PointCloud& cloud) {
  PointCloud result;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    result.points.push_back(cloud.points[i]);
    if (!cloud.labels.empty()) result.labels.push_back(cloud.labels[i]);
    if (!cloud.colors.empty()) result.colors.push_back(cloud.colors[i]);
  }
  return result;
}

std::vector<Vector3d> positions_of(const PointCloud& cloud) {
  std::vector<Vector3d> positions;
  positions.reserve(cloud.points.size());
  for (const Vector3f& point : cloud.points) positions.emplace_back(point.cast<double>());
  return positions;
}

// ---- Colours
// -----------------------------------------------------------------------------------------------

std::vector<Color> colors_by_label(const std::vector<std::int32_t>& labels, const std::string& name) {
  const std::vector<Color> color_of = palette(std::max(0, *std::ranges::max_element(labels)), name);
  std::vector<Color> colors;
  colors.reserve(labels.size());
  for (const std::int32_t label : labels) {
    colors.push_back(label < 0 ? null_color : color_of[static_cast<std::size_t>(label)]);
  }
  return colors;
}

/// From deep blue over green to yellow, increasingly light, for a value in [0, 1].
Color height_color(double share) {
  constexpr std::array<std::array<double, 3>, 5> stops = {
      {{68, 20, 100}, {58, 84, 150}, {36, 142, 148}, {100, 196, 106}, {250, 226, 60}}};
  const double position = share * (stops.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(position), stops.size() - 2);
  const double rest = position - static_cast<double>(lower);
  Color color;
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = static_cast<std::uint8_t>(std::lround(std::lerp(stops[lower][i], stops[lower + 1][i], rest)));
  }
  return color;
}

std::vector<Color> colors_by_height(const std::vector<Vector3d>& positions) {
  const auto z = [](const Vector3d& position) { return position.z(); };
  const auto [lowest, highest] = std::ranges::minmax(positions, {}, z);
  const double range = std::max(highest.z() - lowest.z(), 1e-9);
  std::vector<Color> colors;
  colors.reserve(positions.size());
  for (const Vector3d& position : positions) {
    colors.push_back(height_color((position.z() - lowest.z()) / range));
  }
  return colors;
}

// ---- Surface
// -----------------------------------------------------------------------------------------------

/// A point in the image: its column, row and depth (m).
struct Splat {
  int u;
  int v;
  float depth;
};

std::vector<Splat> splats_of(const std::vector<Vector3d>& positions, const Camera& camera) {
  std::vector<Splat> splats;
  splats.reserve(positions.size());
  const Vector3d optical_axis = camera.pose.linear().col(2);
  for (const Vector3d& position : positions) {
    const Vector2d pixel = project(camera, position).value();  // camera_for() ensures that it is in front
    splats.push_back({.u = static_cast<int>(std::lround(pixel.x())),
                      .v = static_cast<int>(std::lround(pixel.y())),
                      .depth = static_cast<float>(optical_axis.dot(position - camera.pose.translation()))});
  }
  return splats;
}

/// The radius, in samples, at which neighbouring points just form a closed surface, from the area of the
/// image that has points, counted in cells. So it is never much larger than a cell if points are sparse.
int splat_radius(const std::vector<Splat>& splats, const Camera& camera) {
  constexpr int cell_size = 8;
  const auto cell_at = [](int pixel) { return static_cast<std::size_t>(pixel) / cell_size; };
  const std::size_t cells_in_a_row = cell_at(camera.width) + 1;
  const std::size_t rows = cell_at(camera.height) + 1;
  std::vector<bool> occupied(rows * cells_in_a_row);
  for (const Splat& splat : splats) {
    occupied[cell_at(splat.v) * cells_in_a_row + cell_at(splat.u)] = true;
  }
  const auto area = static_cast<double>(std::ranges::count(occupied, true) * cell_size * cell_size);
  return static_cast<int>(std::ceil(std::sqrt(area / static_cast<double>(splats.size()))));
}

/// Draws the splats as discs facing the camera, the nearest in front.
SurfaceImage draw_discs(const std::vector<Splat>& splats, const PointCloud& cloud, int radius,
                        const Camera& camera) {
  SurfaceImage image(camera);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const Splat& splat = splats[i];
    const int object = cloud.labels.empty() ? 0 : cloud.labels[i];
    for (int v = std::max(splat.v - radius, 0); v <= std::min(splat.v + radius, camera.height - 1); ++v) {
      for (int u = std::max(splat.u - radius, 0); u <= std::min(splat.u + radius, camera.width - 1); ++u) {
        const int du = u - splat.u;
        const int dv = v - splat.v;
        if (du * du + dv * dv > radius * radius) continue;
        SurfaceSample& sample = image.at(u, v);
        if (splat.depth >= sample.depth) continue;
        sample.depth = splat.depth;
        sample.color = cloud.colors[i];
        sample.object = object;
      }
    }
  }
  return image;
}

bool is_in_image(const Camera& camera, int u, int v) {
  return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
}

/// The surface normal around a sample, from the plane whose depth fits the neighbours of the same object best
/// (least squares). Of a wide neighbourhood, where points are sparse, some 50 samples tell as much as all.
Vector3f estimate_normal(const SurfaceImage& image, int u, int v, int radius) {
  constexpr float steepest = 4;  // a steeper rise between samples means another surface
  const Camera& camera = image.camera;
  const SurfaceSample& sample = image.at(u, v);
  const auto focal_length = static_cast<float>(camera.fx);
  constexpr int samples_across = 6;
  const int stride = std::max(1, 2 * radius / samples_across);
  const int reach = radius / stride * stride;
  const float largest_step = steepest * static_cast<float>(radius) * sample.depth / focal_length;
  float uu = 0;
  float vv = 0;
  float uv = 0;
  float ud = 0;
  float vd = 0;
  for (int dy = -reach; dy <= reach; dy += stride) {
    for (int dx = -reach; dx <= reach; dx += stride) {
      if (!is_in_image(camera, u + dx, v + dy)) continue;
      const SurfaceSample& other = image.at(u + dx, v + dy);
      const float step = other.depth - sample.depth;
      if (other.object != sample.object || std::abs(step) > largest_step) continue;
      const auto du = static_cast<float>(dx);
      const auto dv = static_cast<float>(dy);
      uu += du * du;
      vv += dv * dv;
      uv += du * dv;
      ud += du * step;
      vd += dv * step;
    }
  }
  const float determinant = uu * vv - uv * uv;
  const bool is_plane = determinant > 0;
  const float depth_by_u = is_plane ? (vv * ud - uv * vd) / determinant : 0;
  const float depth_by_v = is_plane ? (uu * vd - uv * ud) / determinant : 0;
  // The cross product of the derivatives of depth * ((u − cx) / f, (v − cy) / f, 1), divided by depth / f.
  const float a = static_cast<float>(u - camera.cx) / focal_length;
  const float b = static_cast<float>(v - camera.cy) / focal_length;
  const Vector3f normal(depth_by_u, depth_by_v,
                        -(a * depth_by_u + b * depth_by_v + sample.depth / focal_length));
  return camera.pose.linear().cast<float>() * normal.normalized();
}

void estimate_normals(SurfaceImage& image, int radius) {
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      SurfaceSample& sample = image.at(u, v);
      if (std::isfinite(sample.depth)) sample.normal = estimate_normal(image, u, v, radius);
    }
  }
}

}  // namespace

Picture picture_of_cloud(const PointCloud& cloud, const View& view, const std::string& name) {
  validate(view);
  PointCloud points = finite_points(cloud);
  if (points.points.empty()) {
    throw InputError({.file = name, .line = 0, .field = ""}, "a cloud without points", "at least one");
  }
  const std::vector<Vector3d> positions = positions_of(points);
  const Camera camera = camera_for(view, supersampling, positions, name);
  if (!points.labels.empty()) points.colors = colors_by_label(points.labels, name);
  if (points.colors.empty()) points.colors = colors_by_height(positions);

  const std::vector<Splat> splats = splats_of(positions, camera);
  const int radius = splat_radius(splats, camera);
  SurfaceImage image = draw_discs(splats, points, radius, camera);
  estimate_normals(image, 2 * radius + 1);
  return shade(image);
}

}  // namespace tanglebin
