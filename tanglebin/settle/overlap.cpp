#include "tanglebin/settle/overlap.hpp"

#include <algorithm>

namespace tanglebin {
namespace {

double overlap(const Tube& first, const Tube& second) {
  double deepest = 0;
  const std::vector<Capsule> others = capsules(second);
  for (const Capsule& capsule : capsules(first)) {
    for (const Capsule& other : others) deepest = std::max(deepest, -surface_distance(capsule, other));
  }
  return deepest;
}

// The distance of a point from a box is convex along a segment, so a ternary search finds its minimum.
double distance(const Capsule& capsule, const Eigen::AlignedBox3d& box) {
  const auto at = [&](double t) { return box.exteriorDistance(capsule.a + t * (capsule.b - capsule.a)); };
  double low = 0;
  double high = 1;
  while (high - low > 1e-9) {
    const double left = low + (high - low) / 3;
    const double right = high - (high - low) / 3;
    if (at(left) <= at(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return at(low);
}

}  // namespace

double largest_tube_overlap(const std::vector<Tube>& tubes) {
  double deepest = 0;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    for (std::size_t j = i + 1; j < tubes.size(); ++j) {
      if (bounds(tubes[i]).intersects(bounds(tubes[j])))
        deepest = std::max(deepest, overlap(tubes[i], tubes[j]));
    }
  }
  return deepest;
}

double largest_bin_overlap(const std::vector<Tube>& tubes, const Bin& bin) {
  double deepest = 0;
  for (const Tube& tube : tubes) {
    for (const Eigen::AlignedBox3d& box : boxes(bin)) {
      if (!box.intersects(bounds(tube))) continue;
      for (const Capsule& capsule : capsules(tube)) {
        deepest = std::max(deepest, capsule.radius - distance(capsule, box));
      }
    }
  }
  return deepest;
}

}  // namespace tanglebin
