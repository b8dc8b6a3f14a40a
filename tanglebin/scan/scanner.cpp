#include "tanglebin/scan/scanner.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

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

}  // namespace

Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera) {
  validate(camera);
  return ideal_scan(surfaces_of(tubes, bin), camera, 0);
}

Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera, const Sensor& sensor,
          std::uint64_t scene_seed, std::string_view scanner) {
  validate(camera);
  validate(sensor);
  const Surfaces surfaces = surfaces_of(tubes, bin);
  Scan ideal = ideal_scan(surfaces, camera, ray_margin(sensor));
  if (is_ideal(sensor)) return ideal;
  return measure(surfaces, std::move(ideal), sensor, {scene_seed, seed_of_scanner(scene_seed, scanner)});
}

}  // namespace tanglebin
