#include "tanglebin/scan/tile_index.hpp"

#include <algorithm>
#include <cmath>

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

AlignedBox3d bounding_box(const Surfaces& surfaces) {
  AlignedBox3d all = bounding_box(surfaces.capsules);
  for (const AlignedBox3d& box : surfaces.boxes) all.extend(box);
  return all;
}

/// A bound on the sine of the angle between the rays through a tile's centre and through any point of it:
/// their distance in the image plane at unit distance, as projecting that plane onto the unit sphere
/// lengthens nothing.
double tile_spread(const Camera& camera, double margin, int tile_size) {
  const double half = (tile_size - 1) / 2.0 + margin;
  return std::hypot(half / camera.fx, half / camera.fy);
}

/// 8 pixels, fastest for the presets; fewer where those would span a large angle.
int choose_tile_size(const Camera& camera, double margin) {
  constexpr double largest_spread = 0.25;
  int size = 8;
  while (size > 1 && tile_spread(camera, margin, size) > largest_spread) size /= 2;
  return size;
}

/// The boxes, so much larger that the central ray of a beam meets one where any ray of the beam meets the
/// true one (see CapsuleIndex); the last term is for rounding.
std::array<AlignedBox3d, 5> thickened(std::array<AlignedBox3d, 5> boxes, const BeamShape& beam) {
  for (AlignedBox3d& box : boxes) {
    const double farthest = (box.center() - beam.origin).norm() + box.diagonal().norm() / 2;
    const Vector3d margin = Vector3d::Constant(farthest * (beam.spread + 1e-9));
    box = AlignedBox3d(box.min() - margin, box.max() + margin);
  }
  return boxes;
}

/// Are both points outside of the same face, and with them all between them?
bool lie_outside_of_a_face(const AlignedBox3d& box, const Vector3d& a, const Vector3d& b) {
  return (a.cwiseMin(b).array() > box.max().array()).any() ||
         (a.cwiseMax(b).array() < box.min().array()).any();
}

}  // namespace

Surfaces surfaces_of(const std::vector<Tube>& tubes, const Bin& bin) {
  Surfaces surfaces{.boxes = boxes(bin), .capsules = {}, .labels = {}};
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      surfaces.capsules.push_back(capsule);
      surfaces.labels.push_back(tube.id);
    }
  }
  return surfaces;
}

PixelWindow window_of(const Surfaces& surfaces, const Camera& camera, double margin) {
  constexpr int corners = 8;
  const AlignedBox3d box = bounding_box(surfaces);
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
  const Vector2d first = (projection.min().array() - margin).floor().matrix().cwiseMax(Vector2d::Zero());
  const Vector2d last = (projection.max().array() + margin).ceil().matrix().cwiseMin(last_pixel);
  if ((first.array() > last.array()).any()) return {};
  return {.left = static_cast<int>(first.x()),
          .top = static_cast<int>(first.y()),
          .width = static_cast<int>(last.x() - first.x()) + 1,
          .height = static_cast<int>(last.y() - first.y()) + 1};
}

std::optional<LabelledHit> first_hit(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray) {
  std::optional<LabelledHit> first;
  const auto keep_nearer = [&](const std::optional<SurfaceHit>& hit, std::int32_t label) {
    if (hit && (!first || hit->distance < first->surface.distance)) first = LabelledHit{*hit, label};
  };
  for (const std::size_t i : candidates.boxes) keep_nearer(ray_box(ray, surfaces.boxes[i]), bin_label);
  for (const std::size_t i : candidates.capsules) {
    keep_nearer(ray_capsule(ray, surfaces.capsules[i]), surfaces.labels[i]);
  }
  return first;
}

bool is_blocked(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray, double distance) {
  const auto blocks = [&](const std::optional<SurfaceHit>& hit) { return hit && hit->distance < distance; };
  // Most ways end on the floor, and its plane tells that it is not between.
  const Vector3d end = ray.origin + distance * ray.direction;
  const auto is_outside = [&](const AlignedBox3d& box) { return lie_outside_of_a_face(box, ray.origin, end); };
  return std::ranges::any_of(candidates.capsules,
                             [&](std::size_t i) { return blocks(ray_capsule(ray, surfaces.capsules[i])); }) ||
         std::ranges::any_of(candidates.boxes, [&](std::size_t i) {
           return !is_outside(surfaces.boxes[i]) && blocks(ray_box(ray, surfaces.boxes[i]));
         });
}

TileIndex::TileIndex(const Surfaces& surfaces, const Camera& camera, double margin)
    : TileIndex(surfaces, camera, margin, choose_tile_size(camera, margin)) {}

TileIndex::TileIndex(const Surfaces& surfaces, const Camera& camera, double margin, int tile_size)
    : camera_(camera),
      tile_size_(tile_size),
      capsule_index_(surfaces.capsules, {camera.pose.translation(), tile_spread(camera, margin, tile_size)}),
      thick_boxes_(
          thickened(surfaces.boxes, {camera.pose.translation(), tile_spread(camera, margin, tile_size)})) {}

void TileIndex::find(int left, int top, Candidates& found) const {
  const double half = (tile_size_ - 1) / 2.0;
  const Ray central = ray_through(camera_, left + half, top + half);
  capsule_index_.candidates(central.direction, found.capsules);
  found.boxes.clear();
  for (std::size_t i = 0; i < thick_boxes_.size(); ++i) {
    if (ray_box(central, thick_boxes_[i])) found.boxes.push_back(i);
  }
}

}  // namespace tanglebin
