#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/intersect.hpp"
#include "tanglebin/pictures/palette.hpp"
#include "tanglebin/pictures/picture.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr Color floor_color{228, 230, 233};
constexpr Color wall_color{220, 223, 228};

std::vector<Vector3d> corners(const AlignedBox3d& box) {
  constexpr int count = 8;
  std::vector<Vector3d> result;
  result.reserve(count);
  for (int i = 0; i < count; ++i) result.push_back(box.corner(static_cast<AlignedBox3d::CornerType>(i)));
  return result;
}

AlignedBox3d bounding_box(const std::vector<Tube>& tubes, const Support& support) {
  AlignedBox3d box;
  for (const Tube& tube : tubes) box.extend(bounds(tube));
  for (const AlignedBox3d& part : solid_parts(support)) {
    for (const Vector3d& corner : corners(part)) box.extend(support.pose * corner);
  }
  return box;
}

constexpr double no_height = 1e-9;  // m, of walls that are not seen

/// The part of a plane under the tubes: the floor of a bin without walls.
Support floor_under(std::vector<Tube> tubes, const Support& plane) {
  AlignedBox3d box(Vector3d::Zero());
  const Eigen::Isometry3d from_world = plane.pose.inverse();
  for (Tube& tube : tubes) {
    transform(tube, from_world);
    box.extend(bounds(tube));
  }
  Support floor{.bin = {.length = box.sizes().x(), .width = box.sizes().y(), .height = no_height}};
  floor.pose = plane.pose * Eigen::Translation3d(box.center().x(), box.center().y(), 0);
  return floor;
}

std::vector<Color> colors_of(const std::vector<Tube>& tubes, const std::string& name) {
  int largest_id = 0;
  for (const Tube& tube : tubes) largest_id = std::max(largest_id, tube.id);
  std::vector<Color> colors = palette(largest_id, name);
  colors[bin_label] = floor_color;
  return colors;
}

/// The tubes and the floor, without walls.
SurfaceImage draw_tubes(const std::vector<Tube>& tubes, const std::vector<Color>& colors, Support support,
                        const Camera& camera) {
  support.bin.height = no_height;
  const Scan seen = scan(tubes, support, camera);
  SurfaceImage image(camera);
  auto pixel = seen.pixels.begin();
  for (int v = seen.window.top; v < seen.window.top + seen.window.height; ++v) {
    for (int u = seen.window.left; u < seen.window.left + seen.window.width; ++u, ++pixel) {
      if (pixel->label == null_label) continue;
      image.at(u, v) = {.depth = pixel->depth,
                        .normal = pixel->normal,
                        .color = colors[static_cast<std::size_t>(pixel->label)],
                        .object = pixel->label};
    }
  }
  return image;
}

bool is_on_viewers_side(const AlignedBox3d& wall, const Camera& camera) {
  const Vector3d outwards(wall.center().x(), wall.center().y(), 0);
  return outwards.dot(camera.pose.translation() - wall.center()) > 0;
}

/// Adds the walls; those on the viewer's side are transparent.
void draw_walls(const Support& support, SurfaceImage& image) {
  Camera camera = image.camera;
  camera.pose = support.pose.inverse() * camera.pose;  // the walls are aligned in the bin's frame
  const Vector3d optical_axis = camera.pose.linear().col(2);
  const std::array<AlignedBox3d, 5> parts = boxes(support.bin);  // the floor and four walls
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Ray ray = ray_through(camera, u, v);
      SurfaceSample& sample = image.at(u, v);
      for (int wall = 1; wall <= 4; ++wall) {
        const AlignedBox3d& box = parts[static_cast<std::size_t>(wall)];
        const auto hit = ray_box(ray, box);
        if (!hit) continue;
        const auto depth = static_cast<float>(hit->distance * optical_axis.dot(ray.direction));
        if (depth >= sample.depth) continue;
        if (is_on_viewers_side(box, camera)) {
          sample.glass = std::max(sample.glass, wall);
        } else {
          sample = {.depth = depth,
                    .normal = (support.pose.linear() * hit->normal).cast<float>(),
                    .color = wall_color,
                    .object = bin_label,
                    .glass = sample.glass};
        }
      }
    }
  }
}

}  // namespace

Picture picture_of_tubes(const std::vector<Tube>& tubes, const Support& support, const View& view,
                         const std::string& name) {
  validate(view);
  const Support shown = support.shape == Support::Shape::plane ? floor_under(tubes, support) : support;
  const AlignedBox3d box = bounding_box(tubes, shown);
  if (box.isEmpty()) throw InputError({name, 0, ""}, "no tubes", "at least one, or a bin to draw");
  const Camera camera = camera_for(view, supersampling, corners(box), name);
  SurfaceImage image = draw_tubes(tubes, colors_of(tubes, name), shown, camera);
  if (shown.shape == Support::Shape::bin) draw_walls(shown, image);
  return shade(image);
}

}  // namespace tanglebin
