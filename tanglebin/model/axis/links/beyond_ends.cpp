#include "tanglebin/model/axis/links/beyond_ends.hpp"

namespace tanglebin {

void look_beyond_ends(std::vector<Fragment>& fragments, double radius, const RangeImage& seen) {
  // Radii. A round end is one beyond the end of the axis.
  constexpr double first = 1.6;
  constexpr double step = 0.6;
  constexpr double farthest = 40;
  for (Fragment& fragment : fragments) {
    for (FragmentEnd& end : fragment.ends) {
      const auto is_empty = [&](double way) {
        return seen.shows_empty(end.position + way * radius * end.outward, radius);
      };
      double way = first;
      while (way < farthest && !(is_empty(way) && is_empty(way + step))) way += step;
      end.hidden = (way - first) * radius;
    }
  }
}

double unseen_length(double length, double hidden, const TubeKind& kind, const LinkSettings& settings) {
  constexpr double slack = 2;  // radii
  return kind.length_min * (1 - settings.length_tolerance) - length - settings.hidden_stretch * hidden -
         slack * kind.radius;
}

}  // namespace tanglebin
