#include "tanglebin/score/metrics.hpp"

#include <cstdint>
#include <vector>

namespace tanglebin {
namespace {

std::int64_t pairs(std::int64_t points) {
  return points * (points - 1) / 2;
}

template <class Counted>
std::int64_t pairs_within(const std::vector<Counted>& parts) {
  std::int64_t sum = 0;
  for (const Counted& part : parts) sum += pairs(part.points);
  return sum;
}

std::int64_t points_of(const std::vector<Region>& regions) {
  std::int64_t sum = 0;
  for (const Region& region : regions) sum += region.points;
  return sum;
}

}  // namespace

Detection detection(const Confusion& confusion) {
  double detected = 0.0;
  double iou_sum = 0.0;
  for (const Overlap& overlap : confusion.overlaps) {
    const double overlap_iou = iou(confusion, overlap);
    if (overlap_iou <= 0.5) continue;
    detected += 1.0;
    iou_sum += overlap_iou;
  }
  if (detected == 0.0) return {0.0, 0.0, 0.0, 0.0};
  const auto tubes = static_cast<double>(confusion.tubes.size());
  const auto segments = static_cast<double>(confusion.segments.size());
  // TP + FP/2 + FN/2, where TP + FN is the number of tubes and TP + FP that of segments.
  const double mean_size = (tubes + segments) / 2;
  return {detected / segments, detected / tubes, detected / mean_size, iou_sum / mean_size};
}

double adjusted_rand_index(const Confusion& confusion) {
  const std::int64_t in_tubes = pairs_within(confusion.tubes);
  const std::int64_t in_segments = pairs_within(confusion.segments);
  const std::int64_t all = pairs(points_of(confusion.tubes));
  // Both sides have a single cluster, or only single points: 0/0 in the formula, but full agreement.
  if (in_tubes == in_segments && (in_tubes == 0 || in_tubes == all)) return 1.0;
  const auto in_both = static_cast<double>(pairs_within(confusion.overlaps));
  const double expected =
      static_cast<double>(in_tubes) * static_cast<double>(in_segments) / static_cast<double>(all);
  const double most = static_cast<double>(in_tubes + in_segments) / 2;
  return (in_both - expected) / (most - expected);
}

}  // namespace tanglebin
