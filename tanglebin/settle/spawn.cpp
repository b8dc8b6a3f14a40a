#include "tanglebin/settle/spawn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace tanglebin {
namespace {

constexpr double clearance = 0.002;                // m, between tubes, and over the rim
constexpr double raise_step = 0.005;               // m, step of the search for a free height
constexpr double steepest = std::numbers::pi / 4;  // rad; an upright tube would fall out of a low bin
constexpr int turns = 32;                          // headings tried until the outline fits the opening

// The direction between the two nodes that are farthest apart.
Eigen::Vector3d long_axis(const Tube& tube) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (const Node& first : tube.nodes) {
    for (const Node& second : tube.nodes) {
      const Eigen::Vector3d line = second.position - first.position;
      if (line.squaredNorm() > longest.squaredNorm()) longest = line;
    }
  }
  return longest.normalized();
}

// Tilts a tube whose long axis is steeper than `steepest` down to that slope.
void lay_down(Tube& tube) {
  const Eigen::Vector3d axis = long_axis(tube);
  const Eigen::Vector3d up = axis.z() < 0 ? Eigen::Vector3d(-axis) : axis;
  const double slope = std::asin(std::min(1.0, up.z()));
  if (slope <= steepest) return;
  const Eigen::Vector3d horizontal = up.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d hinge = horizontal.norm() > 1e-9 ? horizontal.normalized() : Eigen::Vector3d::UnitY();
  transform(tube, Eigen::Isometry3d(Eigen::AngleAxisd(steepest - slope, hinge)));
}

void turn_about_vertical(Tube& tube, double angle) {
  transform(tube, Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())));
}

void shift(Tube& tube, const Eigen::Vector3d& by) {
  transform(tube, Eigen::Isometry3d(Eigen::Translation3d(by)));
}

// By how much the outline exceeds the opening, in the worse of the two directions; negative if it fits.
double overhang(const Tube& tube, const Bin& bin) {
  const Eigen::Vector3d size = bounds(tube).sizes();
  return std::max(size.x() - bin.length, size.y() - bin.width);
}

// Keeps the first heading that fits, or else the one with the least overhang.
void turn_to_fit(Rng& rng, Tube& tube, const Bin& bin) {
  Tube best = tube;
  for (int turn = 0; turn < turns && overhang(best, bin) > 0; ++turn) {
    Tube turned = tube;
    turn_about_vertical(turned, uniform_real(rng, 0.0, 2.0 * std::numbers::pi));
    if (overhang(turned, bin) < overhang(best, bin)) best = std::move(turned);
  }
  tube = std::move(best);
}

// Moves the tube to a random position above the opening, centred in a direction in which it does not fit.
void place_over_opening(Rng& rng, Tube& tube, const Bin& bin) {
  const Eigen::AlignedBox3d box = bounds(tube);
  const double free_x = std::max(0.0, bin.length - box.sizes().x()) / 2;
  const double free_y = std::max(0.0, bin.width - box.sizes().y()) / 2;
  const double x = uniform_real(rng, -free_x, free_x);
  const double y = uniform_real(rng, -free_y, free_y);
  shift(tube, Eigen::Vector3d(x, y, bin.height + clearance + box.sizes().z() / 2) - box.center());
}

bool is_clear_of(const Tube& tube, const Tube& other) {
  Eigen::AlignedBox3d reach = bounds(tube);
  reach.min().array() -= clearance;
  reach.max().array() += clearance;
  if (!reach.intersects(bounds(other))) return true;
  const std::vector<Capsule> others = capsules(other);
  return std::ranges::all_of(capsules(tube), [&](const Capsule& capsule) {
    return std::ranges::all_of(
        others, [&](const Capsule& second) { return surface_distance(capsule, second) >= clearance; });
  });
}

void raise_until_clear(Tube& tube, std::span<const Tube> placed) {
  const auto is_clear = [&](const Tube& other) { return is_clear_of(tube, other); };
  while (!std::ranges::all_of(placed, is_clear)) shift(tube, raise_step * Eigen::Vector3d::UnitZ());
}

}  // namespace

void spawn(Rng& rng, std::vector<Tube>& tubes, const Bin& bin) {
  validate(tubes);
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    lay_down(tubes[i]);
    turn_to_fit(rng, tubes[i], bin);
    place_over_opening(rng, tubes[i], bin);
    raise_until_clear(tubes[i], std::span(tubes).first(i));
  }
}

}  // namespace tanglebin
