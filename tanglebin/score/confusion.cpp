#include "tanglebin/score/confusion.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

using PointCounts = std::map<std::int32_t, std::int64_t>;  // label → points

std::vector<Region> regions(const PointCounts& counts) {
  std::vector<Region> result;
  result.reserve(counts.size());
  for (const auto& [label, points] : counts) result.push_back({label, points});
  return result;
}

std::size_t index_of(const std::vector<Region>& regions, std::int32_t label) {
  const auto region = std::ranges::lower_bound(regions, label, {}, &Region::label);
  return static_cast<std::size_t>(region - regions.begin());
}

}  // namespace

Confusion count_overlaps(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted) {
  if (truth.size() != predicted.size())
    throw std::invalid_argument("truth and prediction must have the same number of labels");
  PointCounts tubes;
  PointCounts segments;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> cells;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] <= bin_label) continue;
    ++tubes[truth[i]];
    if (predicted[i] <= bin_label) continue;
    ++segments[predicted[i]];
    ++cells[{truth[i], predicted[i]}];
  }
  Confusion confusion{regions(tubes), regions(segments), {}};
  confusion.overlaps.reserve(cells.size());
  for (const auto& [labels, points] : cells) {
    confusion.overlaps.push_back(
        {index_of(confusion.tubes, labels.first), index_of(confusion.segments, labels.second), points});
  }
  return confusion;
}

double iou(const Confusion& confusion, const Overlap& overlap) {
  const std::int64_t in_either =
      confusion.tubes[overlap.tube].points + confusion.segments[overlap.segment].points - overlap.points;
  return static_cast<double>(overlap.points) / static_cast<double>(in_either);
}

}  // namespace tanglebin
