#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "tanglebin/score/metrics.hpp"

namespace tanglebin {
namespace {

// In the order of preference of Hoover et al. when two fit equally well.
enum class Kind { correct, over_segmented, under_segmented };

struct Instance {
  Kind kind;
  double fit;  // mean of the overlap's shares of its tubes and of its segments
  std::vector<std::size_t> tubes;
  std::vector<std::size_t> segments;
};

double share(std::int64_t part, std::int64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

bool is_most(std::int64_t part, std::int64_t whole) {
  return 2 * part > whole;
}

std::vector<Instance> correct_instances(const Confusion& confusion) {
  std::vector<Instance> instances;
  for (const auto& [tube, segment, points] : confusion.overlaps) {
    const std::int64_t tube_points = confusion.tubes[tube].points;
    const std::int64_t segment_points = confusion.segments[segment].points;
    if (!is_most(points, tube_points) || !is_most(points, segment_points)) continue;
    const double fit = (share(points, tube_points) + share(points, segment_points)) / 2;
    instances.push_back({Kind::correct, fit, {tube}, {segment}});
  }
  return instances;
}

std::vector<Instance> over_segmented_instances(const Confusion& confusion) {
  struct Parts {
    std::vector<std::size_t> segments;
    std::int64_t points = 0;  // of all segments together
    std::int64_t on_tube = 0;
  };
  std::vector<Parts> parts(confusion.tubes.size());
  for (const auto& [tube, segment, points] : confusion.overlaps) {
    const std::int64_t segment_points = confusion.segments[segment].points;
    if (!is_most(points, segment_points)) continue;
    parts[tube].segments.push_back(segment);
    parts[tube].points += segment_points;
    parts[tube].on_tube += points;
  }
  std::vector<Instance> instances;
  for (std::size_t tube = 0; tube < parts.size(); ++tube) {
    const auto& [segments, points, on_tube] = parts[tube];
    const std::int64_t tube_points = confusion.tubes[tube].points;
    if (segments.size() < 2 || !is_most(on_tube, tube_points)) continue;
    const double fit = (share(on_tube, tube_points) + share(on_tube, points)) / 2;
    instances.push_back({Kind::over_segmented, fit, {tube}, segments});
  }
  return instances;
}

Confusion transposed(const Confusion& confusion) {
  Confusion result{confusion.segments, confusion.tubes, {}};
  for (const auto& [tube, segment, points] : confusion.overlaps) {
    result.overlaps.push_back({segment, tube, points});
  }
  return result;
}

// Under-segmentation is over-segmentation with tubes and segments exchanged.
std::vector<Instance> under_segmented_instances(const Confusion& confusion) {
  std::vector<Instance> instances = over_segmented_instances(transposed(confusion));
  for (Instance& instance : instances) {
    instance.kind = Kind::under_segmented;
    std::swap(instance.tubes, instance.segments);
  }
  return instances;
}

std::vector<Instance> all_instances(const Confusion& confusion) {
  std::vector<Instance> all = correct_instances(confusion);
  std::ranges::move(over_segmented_instances(confusion), std::back_inserter(all));
  std::ranges::move(under_segmented_instances(confusion), std::back_inserter(all));
  return all;
}

// The tubes, or the segments, that are in a counted instance.
class Members {
public:
  explicit Members(std::size_t count) : taken_(count) {}

  bool none_of(const std::vector<std::size_t>& indices) const {
    return std::ranges::none_of(indices, [&](std::size_t i) { return taken_[i]; });
  }
  void take(const std::vector<std::size_t>& indices) {
    for (const std::size_t i : indices) taken_[i] = true;
  }
  std::size_t left() const { return static_cast<std::size_t>(std::ranges::count(taken_, false)); }

private:
  std::vector<bool> taken_;
};

}  // namespace

Instances count_instances(const Confusion& confusion) {
  std::vector<Instance> candidates = all_instances(confusion);
  // Instances of one kind share no member, so the order among equals does not matter.
  std::ranges::stable_sort(candidates, [](const Instance& a, const Instance& b) {
    return std::pair(-a.fit, a.kind) < std::pair(-b.fit, b.kind);
  });
  Instances counts;
  Members tubes(confusion.tubes.size());
  Members segments(confusion.segments.size());
  for (const Instance& instance : candidates) {
    if (!tubes.none_of(instance.tubes) || !segments.none_of(instance.segments)) continue;
    tubes.take(instance.tubes);
    segments.take(instance.segments);
    switch (instance.kind) {
      case Kind::correct:
        ++counts.correct;
        break;
      case Kind::over_segmented:
        ++counts.over_segmented;
        break;
      case Kind::under_segmented:
        ++counts.under_segmented;
        break;
    }
  }
  counts.missed = tubes.left();
  counts.noise = segments.left();
  return counts;
}

}  // namespace tanglebin
