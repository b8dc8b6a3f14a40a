#include "tanglebin/model/axis/links/beyond_ends.hpp"

#include <Eigen/Geometry>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// The direction nearest to this one in which a tube can go on from a place for this way, m: along the wall or
// floor that it meets. The direction itself, if it meets none or would have to turn by more than 60°. What is
// solid has its sides along the axes.
Vector3d past_solid(const Vector3d& direction, const Vector3d& place, double way, double radius,
                    const RangeImage& seen) {
  const auto is_free = [&](const Vector3d& along) { return !seen.is_solid(place + way * along, radius); };
  if (is_free(direction)) return direction;
  Vector3d best = direction;
  double most = 0.5;  // of the direction, that goes along a side
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d along = direction;
    along[axis] = 0;
    const double share = along.norm();
    if (share <= most || !is_free(along / share)) continue;
    most = share;
    best = along / share;
  }
  return best;
}

double hidden_way(const FragmentEnd& end, double radius, const RangeImage& seen) {
  // Radii. A round end is one beyond the end of the axis.
  constexpr double first = 1.6;
  constexpr double step = 0.6;
  constexpr double farthest = 40;
  const double stride = step * radius;
  Vector3d direction = end.outward;
  Vector3d place = end.position + (first - step) * radius * direction;
  const auto go_on = [&] {
    direction = past_solid(direction, place, stride, radius, seen);
    place += stride * direction;
  };
  const auto is_seen_to_end = [&] {
    return seen.shows_empty(place, radius) && seen.shows_empty(place + stride * direction, radius);
  };
  double way = first;
  for (go_on(); way < farthest && !is_seen_to_end(); way += step) go_on();
  return (way - first) * radius;
}

}  // namespace

void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen) {
  for (Fragment& fragment : fragments) {
    for (FragmentEnd& end : fragment.ends) end.hidden = hidden_way(end, radius, seen);
  }
}

double unseen_length(double length, double hidden, const TubeKind& kind, const LinkSettings& settings) {
  constexpr double slack = 2;  // radii
  return kind.length_min * (1 - settings.length_tolerance) - length - settings.hidden_stretch * hidden -
         slack * kind.radius;
}

}  // namespace tanglebin
