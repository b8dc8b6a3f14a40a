#include "tanglebin/scan/tile_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// An upper bound on the sine of the angle between the rays through a tile's centre and through any of its
/// points: their distance in the image plane at unit distance. (Projecting that plane onto the unit sphere
/// lengthens nothing.)
double tile_spread(const Camera& camera, double margin, int tile_size) {
  const double half = (tile_size - 1) / 2.0 + margin;
  return std::hypot(half / camera.fx, half / camera.fy);
}

/// 8 pixels, which is fastest for the presets; fewer if that would span a large angle.
int choose_tile_size(const Camera& camera, double margin) {
  constexpr double largest_spread = 0.25;
  int size = 8;
  while (size > 1 && tile_spread(camera, margin, size) > largest_spread) size /= 2;
  return size;
}

constexpr double rounding = 1e-9;  // m

/// Thickens the boxes so that the central ray of a beam meets one wherever a ray of the beam meets the true
/// one, and no later.
std::vector<AlignedBox3d> thickened(std::vector<AlignedBox3d> boxes, const BeamShape& beam) {
  for (AlignedBox3d& box : boxes) {
    const double farthest = (box.center() - beam.origin).norm() + box.diagonal().norm() / 2;
    const Vector3d margin = Vector3d::Constant(farthest * (beam.spread + rounding));
    box = AlignedBox3d(box.min() - margin, box.max() + margin);
  }
  return boxes;
}

std::vector<Capsule> thickened(std::vector<Capsule> capsules, const BeamShape& beam) {
  for (Capsule& capsule : capsules) {
    capsule = {.a = capsule.a, .b = capsule.b, .radius = radius_for_beam(capsule, beam) + rounding};
  }
  return capsules;
}

/// Adds the hit of a beam's central ray with a thickened surface. A ray that starts inside has already met
/// it.
void add(std::vector<Candidate>& candidates, std::size_t index, const std::optional<SurfaceHit>& hit,
         const Ray& central) {
  if (!hit) return;
  const bool enters = hit->normal.dot(central.direction) < 0;
  candidates.push_back({index, enters ? hit->distance : 0});
}

/// True if both points, and so everything between them, are outside the same face.
bool lie_outside_of_a_face(const AlignedBox3d& box, const Vector3d& a, const Vector3d& b) {
  return (a.cwiseMin(b).array() > box.max().array()).any() ||
         (a.cwiseMax(b).array() < box.min().array()).any();
}

}  // namespace

Surfaces surfaces_of(const std::vector<Tube>& tubes, std::vector<AlignedBox3d> boxes) {
  validate(tubes);
  Surfaces surfaces{.boxes = std::move(boxes), .capsules = {}, .labels = {}};
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      surfaces.capsules.push_back(capsule);
      surfaces.labels.push_back(tube.id);
    }
  }
  return surfaces;
}

Surfaces surfaces_of(const std::vector<Tube>& tubes, const Bin& bin) {
  const auto parts = boxes(bin);
  return surfaces_of(tubes, {parts.begin(), parts.end()});
}

PixelWindow window_of(const Surfaces& surfaces, const Camera& camera, double margin) {
  constexpr int corners = 8;
  const AlignedBox3d box = bounding_box(surfaces);
  if (box.isEmpty()) return {};
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
  std::pair<double, std::size_t> place(std::numeric_limits<double>::infinity(), 0);  // distance, then order
  const auto keep_nearer = [&](const std::optional<SurfaceHit>& hit, std::int32_t label, std::size_t order) {
    if (!hit || std::pair(hit->distance, order) >= place) return;
    first = LabelledHit{*hit, label};
    place = {hit->distance, order};
  };
  for (const auto& [i, nearest] : candidates.capsules) {
    if (nearest > place.first) break;
    keep_nearer(ray_capsule(ray, surfaces.capsules[i]), surfaces.labels[i], surfaces.boxes.size() + i);
  }
  for (const auto& [i, nearest] : candidates.boxes) {
    if (nearest > place.first) break;
    keep_nearer(ray_box(ray, surfaces.boxes[i]), bin_label, i);
  }
  return first;
}

bool is_blocked(const Surfaces& surfaces, const Candidates& candidates, const Ray& ray, double distance) {
  for (const auto& [i, nearest] : candidates.capsules) {
    if (nearest >= distance) break;
    if (const auto hit = ray_capsule(ray, surfaces.capsules[i]); hit && hit->distance < distance) return true;
  }
  // Most paths end on the floor, whose plane shows that it is not in between.
  const Vector3d end = ray.origin + distance * ray.direction;
  for (const auto& [i, nearest] : candidates.boxes) {
    if (nearest >= distance) break;
    if (lie_outside_of_a_face(surfaces.boxes[i], ray.origin, end)) continue;
    if (const auto hit = ray_box(ray, surfaces.boxes[i]); hit && hit->distance < distance) return true;
  }
  return false;
}

TileIndex::TileIndex(const Surfaces& surfaces, const Camera& camera, double margin)
    : camera_(camera),
      tile_size_(choose_tile_size(camera, margin)),
      beam_{camera.pose.translation(), tile_spread(camera, margin, tile_size_)},
      capsule_index_(surfaces.capsules, beam_),
      thick_capsules_(thickened(surfaces.capsules, beam_)),
      thick_boxes_(thickened(surfaces.boxes, beam_)) {}

void TileIndex::find(int left, int top, Candidates& found) const {
  const double half = (tile_size_ - 1) / 2.0;
  const Ray central = ray_through(camera_, left + half, top + half);
  std::vector<std::size_t> capsules;
  capsule_index_.candidates(central.direction, capsules);
  found.capsules.clear();
  for (const std::size_t i : capsules)
    add(found.capsules, i, ray_capsule(central, thick_capsules_[i]), central);
  std::ranges::sort(found.capsules, {}, &Candidate::nearest);
  found.boxes.clear();
  for (std::size_t i = 0; i < thick_boxes_.size(); ++i) {
    add(found.boxes, i, ray_box(central, thick_boxes_[i]), central);
  }
  std::ranges::sort(found.boxes, {}, &Candidate::nearest);
}

}  // namespace tanglebin
