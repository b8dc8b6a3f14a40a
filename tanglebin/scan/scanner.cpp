#include "tanglebin/scan/scanner.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/scan/measure.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

Pixel shade(const Ray& ray, const LabelledHit& hit, const Vector3d& optical_axis) {
  const auto& [range, normal] = hit.surface;
  return {.depth = static_cast<float>(range * optical_axis.dot(ray.direction)),
          .range = static_cast<float>(range),
          .point = (ray.origin + range * ray.direction).cast<float>(),
          .normal = normal.cast<float>(),
          .incidence = static_cast<float>(incidence_of(ray, normal)),
          .label = hit.label};
}

Scan ideal_scan(const Surfaces& surfaces, const Camera& camera, double window_margin) {
  const PixelWindow window = window_of(surfaces, camera, window_margin);
  const int right = window.left + window.width;
  const int bottom = window.top + window.height;
  const TileIndex index(surfaces, camera, 0);
  const int tile_size = index.tile_size();
  const Vector3d optical_axis = camera.pose.linear().col(2);

  Scan result{.camera = camera, .window = window, .pixels = {}};
  result.pixels.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height),
                       empty_pixel());
  Candidates candidates;
  const auto trace_pixel = [&](int u, int v) {
    const Ray ray = ray_through(camera, u, v);
    const auto hit = first_hit(surfaces, candidates, ray);
    if (hit) result.at(u, v) = shade(ray, *hit, optical_axis);
  };
  for (int top = window.top; top < bottom; top += tile_size) {
    for (int left = window.left; left < right; left += tile_size) {
      index.find(left, top, candidates);
      for (int v = top; v < std::min(top + tile_size, bottom); ++v) {
        for (int u = left; u < std::min(left + tile_size, right); ++u) trace_pixel(u, v);
      }
    }
  }
  return result;
}

// A scene's only scanner needs no name and uses the scene's seed.
std::uint64_t seed_of_scanner(std::uint64_t scene_seed, std::string_view scanner) {
  return scanner.empty() ? scene_seed : attempt_seed(scene_seed, scanner, 0, 0, 0);
}

Scan measured_scan(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor,
                   std::uint64_t scene_seed, std::string_view scanner) {
  validate(camera);
  validate(sensor);
  Scan ideal = ideal_scan(surfaces, camera, ray_margin(sensor));
  if (is_ideal(sensor)) return ideal;
  return measure(surfaces, std::move(ideal), sensor, {scene_seed, seed_of_scanner(scene_seed, scanner)});
}

// The boxes are aligned in the support's frame.
std::vector<Eigen::AlignedBox3d> bounded_parts(const Support& support) {
  const Eigen::AlignedBox3d seen(Vector3d::Constant(-scanned_plane), Vector3d::Constant(scanned_plane));
  std::vector<Eigen::AlignedBox3d> parts = solid_parts(support);
  for (Eigen::AlignedBox3d& part : parts) part = part.intersection(seen);
  return parts;
}

std::vector<Tube> moved(std::vector<Tube> tubes, const Eigen::Isometry3d& motion) {
  for (Tube& tube : tubes) transform(tube, motion);
  return tubes;
}

Scan moved(Scan scan, const Eigen::Isometry3d& motion, const Camera& camera) {
  scan.camera = camera;
  for (Pixel& pixel : scan.pixels) {
    pixel.point = (motion * pixel.point.cast<double>()).cast<float>();
    pixel.normal = (motion.linear() * pixel.normal.cast<double>()).cast<float>();
  }
  return scan;
}

}  // namespace

Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera) {
  validate(camera);
  return ideal_scan(surfaces_of(tubes, bin), camera, 0);
}

Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner) {
  return measured_scan(surfaces_of(tubes, bin), camera, sensor, scene_seed, scanner);
}

Scan scan(const std::vector<Tube>& tubes, const Support& support, const Camera& camera) {
  return scan(tubes, support, camera, Sensor{}, 0);
}

Scan scan(const std::vector<Tube>& tubes, const Support& support, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner) {
  const std::vector<Eigen::AlignedBox3d> parts = bounded_parts(support);
  if (support.pose.matrix() == Eigen::Matrix4d::Identity())
    return measured_scan(surfaces_of(tubes, parts), camera, sensor, scene_seed, scanner);
  const Eigen::Isometry3d from_world = support.pose.inverse();
  Camera seen_from = camera;
  seen_from.pose = from_world * camera.pose;
  return moved(
      measured_scan(surfaces_of(moved(tubes, from_world), parts), seen_from, sensor, scene_seed, scanner),
      support.pose, camera);
}

}  // namespace tanglebin
