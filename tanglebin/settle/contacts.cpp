#include "tanglebin/settle/contacts.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tanglebin/geometry/capsule_box.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// A place where two surfaces touch.
struct Touch {
  Vector3d point;
  double gap;
};

// The touch of a sphere around `centre` and a solid whose nearest point, or nearest sphere's centre, is
// `other`; `gap` apart.
Touch touch_between(const Vector3d& centre, double radius, const Vector3d& other, double gap) {
  const Vector3d apart = other - centre;
  const double distance = apart.norm();
  if (distance == 0) return {centre, gap};
  return {centre + apart / distance * (radius + gap / 2), gap};
}

// Adds a touch unless the surfaces are too far apart.
void add_if_touching(std::vector<Touch>& touches, const Touch& touch) {
  if (touch.gap <= touching_gap) touches.push_back(touch);
}

std::vector<Touch> touches_of(const Tube& first, const Tube& second) {
  std::vector<Touch> touches;
  const std::vector<Capsule> others = capsules(second);
  for (const Capsule& capsule : capsules(first)) {
    for (const Capsule& other : others) {
      const SegmentPair pair = closest_points(capsule.a, capsule.b, other.a, other.b);
      const Vector3d on_first = capsule.a + pair.s * (capsule.b - capsule.a);
      const Vector3d on_second = other.a + pair.t * (other.b - other.a);
      add_if_touching(touches, touch_between(on_first, capsule.radius, on_second,
                                             pair.distance - capsule.radius - other.radius));
    }
  }
  return touches;
}

// At the nodes, and where a cylinder between them is nearer: at an edge of the rim.
std::vector<Touch> touches_of(const Tube& tube, const Eigen::AlignedBox3d& box) {
  std::vector<Touch> touches;
  const auto add = [&](const Vector3d& centre) {
    const Vector3d nearest = centre.cwiseMax(box.min()).cwiseMin(box.max());
    add_if_touching(touches,
                    touch_between(centre, tube.radius, nearest, (nearest - centre).norm() - tube.radius));
  };
  for (const Node& node : tube.nodes) add(node.position);
  for (const Capsule& part : capsules(tube)) add(part.a + nearest_on_axis(part, box) * (part.b - part.a));
  return touches;
}

// Those with the smallest gaps of all that are less than `distance` from them.
std::vector<Touch> apart(std::vector<Touch> touches, double distance) {
  std::ranges::stable_sort(touches, {}, &Touch::gap);
  std::vector<Touch> kept;
  for (const Touch& touch : touches) {
    const bool is_new = std::ranges::all_of(
        kept, [&](const Touch& other) { return (other.point - touch.point).norm() >= distance; });
    if (is_new) kept.push_back(touch);
  }
  return kept;
}

Eigen::AlignedBox3d with_margin(Eigen::AlignedBox3d box) {
  box.min().array() -= touching_gap;
  box.max().array() += touching_gap;
  return box;
}

}  // namespace

std::vector<Contact> contacts(const std::vector<Tube>& tubes, const Bin& bin) {
  const std::array<Eigen::AlignedBox3d, 5> parts = boxes(bin);
  std::vector<Contact> found;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const Tube& tube = tubes[i];
    const Eigen::AlignedBox3d reach = with_margin(bounds(tube));
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (!reach.intersects(parts.at(part))) continue;
      for (const auto& [point, gap] : apart(touches_of(tube, parts.at(part)), tube.radius))
        found.push_back({tube.id, bin_label, part, point, gap});
    }
    for (std::size_t j = i + 1; j < tubes.size(); ++j) {
      const Tube& other = tubes[j];
      if (!reach.intersects(bounds(other))) continue;
      for (const auto& [point, gap] : apart(touches_of(tube, other), std::min(tube.radius, other.radius)))
        found.push_back({tube.id, other.id, std::nullopt, point, gap});
    }
  }
  return found;
}

}  // namespace tanglebin
