#include "tanglebin/model/axis/links/junctions.hpp"

#include <array>
#include <map>
#include <optional>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

using Path = std::vector<std::size_t>;  // nodes; the first is a junction

// Radii.
constexpr double parted = 1.6;  // along a branch, where it has separated from the others
constexpr double seen_to = 5;   // along a branch, end of the part that gives its direction
constexpr double back_max = 8;  // along the stem, to the meeting point of the branches
constexpr double miss_max = 1;  // from the meeting point to the stem

// The direction is unknown if the branch is no longer than `parted`.
struct Branch {
  Vector3d start;
  Vector3d direction;
};

// The point on a path at this distance from its first node, or its end.
Vector3d place_along(const LineTree& line, const Path& path, double distance) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d way = line.nodes[path[i + 1]] - line.nodes[path[i]];
    if (way.norm() > distance) return line.nodes[path[i]] + distance * way.normalized();
    distance -= way.norm();
  }
  return line.nodes[path.back()];
}

Branch branch_along(const LineTree& line, const Path& path, double radius) {
  const Vector3d start = place_along(line, path, parted * radius);
  return {start, (place_along(line, path, seen_to * radius) - start).normalized()};
}

// The midpoint of the closest approach of two branches, extended backwards.
Vector3d meeting_place(const Branch& a, const Branch& b, double radius) {
  constexpr double length = 1000;  // radii; practically infinite
  const Vector3d way_a = length * radius * a.direction;
  const Vector3d way_b = length * radius * b.direction;
  const auto [distance, s, t] =
      closest_points(a.start - way_a, a.start + way_a, b.start - way_b, b.start + way_b);
  return (a.start + (2 * s - 1) * way_a + b.start + (2 * t - 1) * way_b) / 2;
}

// The distance along a path of its point nearest to `point`; none if it is too far along, or too far from
// `point`.
std::optional<double> way_back(const LineTree& line, const Path& stem, const Vector3d& point, double radius) {
  double nearest = (point - line.nodes[stem.front()]).norm();
  double nearest_way = 0;
  double way = 0;
  for (std::size_t i = 0; i + 1 < stem.size(); ++i) {
    const Vector3d& a = line.nodes[stem[i]];
    const Vector3d& b = line.nodes[stem[i + 1]];
    const double t = nearest_on_axis({a, b, 0}, point);
    const double distance = (point - (a + t * (b - a))).norm();
    if (distance < nearest) {
      nearest = distance;
      nearest_way = way + t * (b - a).norm();
    }
    way += (b - a).norm();
  }
  if (nearest_way <= 0 || nearest_way > back_max * radius || nearest > miss_max * radius) return std::nullopt;
  return nearest_way;
}

// Replaces the first part of a path, up to this distance, by a straight line that starts at `from`.
void draw_straight(LineTree& line, const Path& path, double distance, const Vector3d& from) {
  const Vector3d to = place_along(line, path, distance);
  Vector3d before = line.nodes[path.front()];
  double way = 0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    Vector3d& node = line.nodes[path[i]];
    way += (node - before).norm();
    if (way >= distance) return;
    before = node;
    node = from + way / distance * (to - from);
  }
}

void draw_back(LineTree& line, const std::array<Path, 3>& paths, double radius) {
  std::array<Branch, 3> branches;
  for (std::size_t i = 0; i < 3; ++i) branches[i] = branch_along(line, paths[i], radius);
  // The stem is the branch opposite the sharpest angle.
  std::size_t stem = 0;
  double sharpest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double cosine = branches[(i + 1) % 3].direction.dot(branches[(i + 2) % 3].direction);
    if (cosine <= sharpest) continue;
    sharpest = cosine;
    stem = i;
  }
  constexpr double blunt = 0.0;        // cosines: a right angle ...
  constexpr double parallel = 0.9995;  // ... and an angle too small to locate the intersection
  if (sharpest <= blunt || sharpest >= parallel) return;
  const std::size_t first = (stem + 1) % 3;
  const std::size_t second = (stem + 2) % 3;
  const Vector3d meeting = meeting_place(branches[first], branches[second], radius);
  const std::optional<double> back = way_back(line, paths[stem], meeting, radius);
  if (!back) return;
  const Vector3d junction = place_along(line, paths[stem], *back);
  draw_straight(line, paths[first], parted * radius, junction);
  draw_straight(line, paths[second], parted * radius, junction);
  draw_straight(line, paths[stem], *back, junction);
  line.nodes[paths[stem].front()] = junction;
}

}  // namespace

LineTree with_junctions_drawn_back(LineTree line, double radius) {
  std::map<std::size_t, std::vector<Path>> paths_from;
  const Paths paths(line);
  for (const Path& path : paths.all()) {
    paths_from[path.front()].push_back(path);
    paths_from[path.back()].emplace_back(path.rbegin(), path.rend());
  }
  for (const auto& [node, from] : paths_from) {
    if (from.size() == 3) draw_back(line, {from[0], from[1], from[2]}, radius);
  }
  return line;
}

}  // namespace tanglebin
