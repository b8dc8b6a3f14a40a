#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tanglebin {

/// The points that have the same label.
struct Region {
  std::int32_t label;
  std::int64_t points;
};

/// The points that a tube and a segment have in common.
struct Overlap {
  std::size_t tube;     ///< index in Confusion::tubes
  std::size_t segment;  ///< index in Confusion::segments
  std::int64_t points;
};

/// The confusion matrix of the truth and a prediction: a row for each tube, a column for each segment, which
/// is what a prediction gives one label. Sparse, since few tubes and segments meet.
struct Confusion {
  std::vector<Region> tubes;      ///< the truth's, ascending by label, none empty
  std::vector<Region> segments;   ///< the prediction's, counted on the tubes only; ascending by label
  std::vector<Overlap> overlaps;  ///< the cells that are not 0, row by row
};

/// Counts the points of tubes: those of label 1 and above in the truth, all others are left out. Where
/// the prediction is 0 (the bin) or null, no segment claims the point. Throws std::invalid_argument for
/// arrays of different lengths.
Confusion count_overlaps(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted);

/// Intersection over union of an overlap's tube and segment.
double iou(const Confusion& confusion, const Overlap& overlap);

}  // namespace tanglebin
