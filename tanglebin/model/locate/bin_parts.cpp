#include "tanglebin/model/locate/bin_parts.hpp"

#include <algorithm>
#include <cmath>

#include "tanglebin/geometry/intersect.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kinds_of_wall = 3;

std::size_t wall_on(int axis, double side) {
  return static_cast<std::size_t>(2 * axis) + (side > 0 ? 1 : 0);
}

// Of a point on the surface of box number `box` of boxes(bin).
std::size_t part_at(const Bin& bin, std::size_t box, const Vector3d& point, const Vector3d& normal) {
  constexpr double upright = 0.5;
  constexpr double rounding = 1e-9;
  if (normal.z() > upright) return box == 0 ? 0 : part_of(PartKind::rim, box - 1);
  const int axis = std::abs(normal.x()) > upright ? 0 : 1;
  const bool is_inside =
      std::abs(point.x()) < bin.length / 2 + rounding && std::abs(point.y()) < bin.width / 2 + rounding;
  return is_inside ? part_of(PartKind::inner, wall_on(axis, -normal[axis]))
                   : part_of(PartKind::outer, wall_on(axis, normal[axis]));
}

Ray ray_of(const SensorView& view, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(view.camera.width);
  const std::size_t row = pixel / width;
  return ray_through(view.camera, static_cast<double>(pixel % width), static_cast<double>(row));
}

// Of a point that was measured along a ray, NaN for none.
Verdict verdict_of(const PartHit& hit, const Vector3d& point, const Ray& ray, double closeness) {
  if (!point.allFinite()) return Verdict::none;
  const double behind = (point.dot(ray.direction) - hit.distance) * hit.cosine;
  if (behind > closeness) return Verdict::contradicted;
  return behind < -closeness ? Verdict::hidden : Verdict::explained;
}

}  // namespace

std::size_t part_of(PartKind kind, std::size_t wall) {
  if (kind == PartKind::floor) return 0;
  return 1 + kinds_of_wall * wall + static_cast<std::size_t>(kind) - 1;
}

PartKind kind_of_part(std::size_t part) {
  return part == 0 ? PartKind::floor : static_cast<PartKind>((part - 1) % kinds_of_wall + 1);
}

std::size_t wall_of_part(std::size_t part) {
  return (part - 1) / kinds_of_wall;
}

std::string name_of_wall(std::size_t wall) {
  constexpr std::array sides{"-x", "+x", "-y", "+y"};
  return std::string("the wall at ") + sides.at(wall);
}

double side_of_wall(std::size_t wall) {
  return wall % 2 == 0 ? -1 : 1;
}

int axis_of_wall(std::size_t wall) {
  return static_cast<int>(wall / 2);
}

PartPlane plane_of_part(const Bin& bin, std::size_t part) {
  const PartKind kind = kind_of_part(part);
  if (kind == PartKind::floor) return {Vector3d::UnitZ(), 0};
  if (kind == PartKind::rim) return {Vector3d::UnitZ(), bin.height};
  const std::size_t wall = wall_of_part(part);
  const int axis = axis_of_wall(wall);
  const double half = (axis == 0 ? bin.length : bin.width) / 2;
  const Vector3d outwards = side_of_wall(wall) * Vector3d::Unit(axis);
  if (kind == PartKind::inner) return {-outwards, -half};
  return {outwards, half + bin.wall};
}

bool are_beside(const Bin& bin, const Eigen::Isometry3d& first, const Eigen::Isometry3d& second) {
  constexpr double inaccuracy = 0.9;
  const double distance = (first.translation() - second.translation()).norm();
  return distance > inaccuracy * std::min(bin.length, bin.width);
}

std::optional<PartHit> first_hit(const std::array<AlignedBox3d, 5>& boxes, const Bin& bin, const Ray& ray) {
  std::optional<SurfaceHit> nearest;
  std::size_t box = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::optional<SurfaceHit> hit = ray_box(ray, boxes[i]);
    if (!hit || (nearest && nearest->distance <= hit->distance)) continue;
    nearest = hit;
    box = i;
  }
  if (!nearest) return std::nullopt;
  const Vector3d point = ray.origin + nearest->distance * ray.direction;
  return PartHit{.part = part_at(bin, box, point, nearest->normal),
                 .distance = nearest->distance,
                 .cosine = -nearest->normal.dot(ray.direction)};
}

std::vector<PixelVerdict> verdicts(const SensorView& view, const std::vector<std::size_t>& pixels,
                                   const Bin& bin, const Isometry3d& pose, double closeness) {
  const Isometry3d from_camera = pose.inverse(Eigen::Isometry);
  const std::array<AlignedBox3d, 5> parts = boxes(bin);
  std::vector<PixelVerdict> verdicts;
  verdicts.reserve(pixels.size());
  for (const std::size_t pixel : pixels) {
    const Ray seen = ray_of(view, pixel);
    const Ray ray{from_camera.translation(), from_camera.linear() * seen.direction};
    const std::optional<PartHit> hit = first_hit(parts, bin, ray);
    if (!hit) {
      verdicts.push_back({std::nullopt, Verdict::none});
      continue;
    }
    verdicts.push_back({hit->part, verdict_of(*hit, view.points[pixel].cast<double>(), seen, closeness)});
  }
  return verdicts;
}

Agreement agreement_of(const std::vector<PixelVerdict>& verdicts) {
  Agreement agreement;
  for (const auto& [part, verdict] : verdicts) {
    if (!part) continue;
    ++agreement.expected.at(*part);
    if (verdict == Verdict::explained) ++agreement.explained.at(*part);
    if (verdict == Verdict::hidden) ++agreement.hidden.at(*part);
    if (verdict == Verdict::contradicted) ++agreement.contradicted.at(*part);
  }
  return agreement;
}

int value_of(Verdict verdict) {
  if (verdict == Verdict::explained) return 1;
  return verdict == Verdict::contradicted ? -2 : 0;
}

int score_of(const std::vector<PixelVerdict>& verdicts) {
  int score = 0;
  for (const PixelVerdict& pixel : verdicts) score += value_of(pixel.verdict);
  return score;
}

}  // namespace tanglebin
