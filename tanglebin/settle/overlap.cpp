#include "tanglebin/settle/overlap.hpp"

#include <algorithm>

#include "tanglebin/geometry/capsule_box.hpp"

namespace tanglebin {
namespace {

// The shapes that collide.
std::vector<Capsule> rounded_capsules(const Tube& tube) {
  std::vector<Capsule> all = capsules(tube);
  std::ranges::transform(all, all.begin(), &rounded);
  return all;
}

double overlap(const Tube& first, const Tube& second) {
  double deepest = 0;
  const std::vector<Capsule> others = rounded_capsules(second);
  for (const Capsule& capsule : rounded_capsules(first)) {
    for (const Capsule& other : others) deepest = std::max(deepest, -surface_distance(capsule, other));
  }
  return deepest;
}

double distance(const Capsule& capsule, const Eigen::AlignedBox3d& box) {
  return box.exteriorDistance(capsule.a + nearest_on_axis(capsule, box) * (capsule.b - capsule.a));
}

}  // namespace

double largest_tube_overlap(const std::vector<Tube>& tubes) {
  validate(tubes);
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
  validate(tubes);
  double deepest = 0;
  for (const Tube& tube : tubes) {
    for (const Eigen::AlignedBox3d& box : boxes(bin)) {
      if (!box.intersects(bounds(tube))) continue;
      for (const Capsule& capsule : rounded_capsules(tube)) {
        deepest = std::max(deepest, capsule.radius - distance(capsule, box));
      }
    }
  }
  return deepest;
}

}  // namespace tanglebin
