#include "tanglebin/model/axis/beyond_ends.hpp"

#include <algorithm>
#include <optional>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// Radii. A round end is one beyond the end of the axis.
constexpr double first = 1.6;
constexpr double step = 0.6;
constexpr double farthest = 40;

/// A way that a tube may take, unseen.
struct HiddenWay {
  double length = 0;             ///< radii
  std::optional<Vector3d> wall;  ///< where the bin stops it, m; none where it was seen to be empty
};

// Straight ahead, until two places in a row were seen to be empty or the bin is in the way.
HiddenWay straight_way(const Vector3d& from, const Vector3d& direction, double radius,
                       const RangeImage& seen) {
  const auto place = [&](double way) -> Vector3d { return from + way * radius * direction; };
  double way = first;
  while (way < farthest) {
    if (seen.is_solid(place(way), radius)) return {way - first, place(way - first)};
    if (seen.shows_empty(place(way), radius) && seen.shows_empty(place(way + step), radius)) break;
    way += step;
  }
  return {way - first, std::nullopt};
}

// The level directions along the bin's walls that do not lead back.
std::vector<Vector3d> directions_along_walls(const Vector3d& outward) {
  constexpr double back = -0.3;
  std::vector<Vector3d> directions = {Vector3d::UnitX(), -Vector3d::UnitX(), Vector3d::UnitY(),
                                      -Vector3d::UnitY()};
  std::erase_if(directions, [&](const Vector3d& direction) { return direction.dot(outward) < back; });
  return directions;
}

void look_beyond(FragmentEnd& end, double radius, const RangeImage& seen) {
  const HiddenWay ahead = straight_way(end.position, end.outward, radius, seen);
  double along_wall = 0;
  if (ahead.wall) {
    for (const Vector3d& direction : directions_along_walls(end.outward))
      along_wall = std::max(along_wall, straight_way(*ahead.wall, direction, radius, seen).length);
  }
  end.hidden = ahead.length * radius;
  end.along_wall = along_wall * radius;
}

}  // namespace

void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen) {
  for (Fragment& fragment : fragments) {
    for (FragmentEnd& end : fragment.ends) look_beyond(end, radius, seen);
  }
}

double unseen_length(double length, double hidden, const TubeKind& kind, const LinkSettings& settings) {
  constexpr double slack = 2;  // radii
  return kind.length_min * (1 - settings.length_tolerance) - length - settings.hidden_stretch * hidden -
         slack * kind.radius;
}

}  // namespace tanglebin
