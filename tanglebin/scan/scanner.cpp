#include "tanglebin/scan/scanner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "tanglebin/scan/capsule_index.hpp"
#include "tanglebin/scan/intersect.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using BinBoxes = std::array<AlignedBox3d, 5>;

/// The capsules of all tubes and the boxes of the bin.
struct Scene {
  BinBoxes boxes;
  std::vector<Capsule> capsules;
  std::vector<std::int32_t> labels;  ///< of the capsules
};

struct LabelledHit {
  SurfaceHit surface;
  std::int32_t label;
};

Scene make_scene(const std::vector<Tube>& tubes, const Bin& bin) {
  Scene scene{.boxes = boxes(bin), .capsules = {}, .labels = {}};
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      scene.capsules.push_back(capsule);
      scene.labels.push_back(tube.id);
    }
  }
  return scene;
}

AlignedBox3d bounding_box(const std::vector<Tube>& tubes, const BinBoxes& boxes) {
  AlignedBox3d all;
  for (const Tube& tube : tubes) all.extend(bounds(tube));
  for (const AlignedBox3d& box : boxes) all.extend(box);
  return all;
}

/// The pixels onto which a box projects; all of them where the box is only partly in front of the camera.
PixelWindow window_of(const AlignedBox3d& box, const Camera& camera) {
  constexpr int corners = 8;
  Eigen::AlignedBox2d projection;
  int behind = 0;
  for (int corner = 0; corner < corners; ++corner) {
    if (const auto pixel = project(camera, box.corner(static_cast<AlignedBox3d::CornerType>(corner)))) {
      projection.extend(*pixel);
    } else {
      ++behind;
    }
  }
  if (behind == corners) return {};
  if (behind > 0) return {.left = 0, .top = 0, .width = camera.width, .height = camera.height};

  const Vector2d last_pixel(camera.width - 1, camera.height - 1);
  const Vector2d first = projection.min().array().floor().matrix().cwiseMax(Vector2d::Zero());
  const Vector2d last = projection.max().array().ceil().matrix().cwiseMin(last_pixel);
  if ((first.array() > last.array()).any()) return {};
  return {.left = static_cast<int>(first.x()),
          .top = static_cast<int>(first.y()),
          .width = static_cast<int>(last.x() - first.x()) + 1,
          .height = static_cast<int>(last.y() - first.y()) + 1};
}

// The image is traced in square tiles. The rays of a tile meet nearly the same things, so what they may meet
// is looked up once for the tile.

/// A bound on the sine of the angle between the rays through a tile's centre and through any of its pixels:
/// their distance in the image plane at unit distance, as projecting that plane onto the unit sphere
/// lengthens nothing.
double tile_spread(const Camera& camera, int tile_size) {
  const double half = (tile_size - 1) / 2.0;
  return std::hypot(half / camera.fx, half / camera.fy);
}

/// 8 pixels, fastest for the presets; fewer where those would span a large angle.
int choose_tile_size(const Camera& camera) {
  constexpr double largest_spread = 0.25;
  int size = 8;
  while (size > 1 && tile_spread(camera, size) > largest_spread) size /= 2;
  return size;
}

/// The boxes, so much larger that the central ray of a beam meets one where any ray of the beam meets the
/// true one (see CapsuleIndex); the last term is for rounding.
BinBoxes thickened(BinBoxes boxes, const BeamShape& beam) {
  for (AlignedBox3d& box : boxes) {
    const double farthest = (box.center() - beam.origin).norm() + box.diagonal().norm() / 2;
    const Vector3d margin = Vector3d::Constant(farthest * (beam.spread + 1e-9));
    box = AlignedBox3d(box.min() - margin, box.max() + margin);
  }
  return boxes;
}

/// Finds what the rays of one tile after another meet first.
class TileTracer {
public:
  TileTracer(const Scene& scene, const BeamShape& tile_beam)
      : scene_(scene),
        origin_(tile_beam.origin),
        capsule_index_(scene.capsules, tile_beam),
        thick_boxes_(thickened(scene.boxes, tile_beam)) {}

  /// Turns to the tile whose centre is seen in this direction.
  void look(const Vector3d& direction) {
    capsule_index_.candidates(direction, near_capsules_);
    near_boxes_.clear();
    for (std::size_t i = 0; i < thick_boxes_.size(); ++i) {
      if (ray_box({origin_, direction}, thick_boxes_[i])) near_boxes_.push_back(scene_.boxes[i]);
    }
  }

  /// For a ray of the tile. Of surfaces at the same distance: the bin, then the tubes in their order.
  std::optional<LabelledHit> first_hit(const Ray& ray) const {
    std::optional<LabelledHit> first;
    const auto keep_nearer = [&](const std::optional<SurfaceHit>& hit, std::int32_t label) {
      if (hit && (!first || hit->distance < first->surface.distance)) first = LabelledHit{*hit, label};
    };
    for (const AlignedBox3d& box : near_boxes_) keep_nearer(ray_box(ray, box), bin_label);
    for (const std::size_t i : near_capsules_) {
      keep_nearer(ray_capsule(ray, scene_.capsules[i]), scene_.labels[i]);
    }
    return first;
  }

private:
  const Scene& scene_;
  Vector3d origin_;
  CapsuleIndex capsule_index_;
  BinBoxes thick_boxes_;
  std::vector<std::size_t> near_capsules_;  ///< indices into the scene's
  std::vector<AlignedBox3d> near_boxes_;
};

Pixel empty_pixel() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  return {.depth = nan,
          .range = nan,
          .point = Eigen::Vector3f::Constant(nan),
          .normal = Eigen::Vector3f::Constant(nan),
          .incidence = nan,
          .label = null_label};
}

Pixel shade(const Ray& ray, const LabelledHit& hit, const Vector3d& optical_axis) {
  const auto& [range, normal] = hit.surface;
  return {.depth = static_cast<float>(range * optical_axis.dot(ray.direction)),
          .range = static_cast<float>(range),
          .point = (ray.origin + range * ray.direction).cast<float>(),
          .normal = normal.cast<float>(),
          .incidence = static_cast<float>(std::acos(std::clamp(-normal.dot(ray.direction), -1.0, 1.0))),
          .label = hit.label};
}

}  // namespace

Scan scan(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera) {
  const Scene scene = make_scene(tubes, bin);
  const PixelWindow window = window_of(bounding_box(tubes, scene.boxes), camera);
  const int right = window.left + window.width;
  const int bottom = window.top + window.height;
  const int tile_size = choose_tile_size(camera);
  const double tile_half = (tile_size - 1) / 2.0;
  TileTracer tracer(scene, {camera.pose.translation(), tile_spread(camera, tile_size)});
  const Vector3d optical_axis = camera.pose.linear().col(2);

  Scan result{.camera = camera, .window = window, .pixels = {}};
  result.pixels.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height),
                       empty_pixel());
  const auto trace_pixel = [&](int u, int v) {
    const Ray ray = ray_through(camera, u, v);
    const auto hit = tracer.first_hit(ray);
    if (hit) result.at(u, v) = shade(ray, *hit, optical_axis);
  };
  for (int top = window.top; top < bottom; top += tile_size) {
    for (int left = window.left; left < right; left += tile_size) {
      tracer.look(ray_through(camera, left + tile_half, top + tile_half).direction);
      for (int v = top; v < std::min(top + tile_size, bottom); ++v) {
        for (int u = left; u < std::min(left + tile_size, right); ++u) trace_pixel(u, v);
      }
    }
  }
  return result;
}

}  // namespace tanglebin
