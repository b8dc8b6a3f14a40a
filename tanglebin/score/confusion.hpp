#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tanglebin {

/// The points with the same label.
struct Region {
  std::int32_t label;
  std::int64_t points;
};

/// The points that a tube and a segment share.
struct Overlap {
  std::size_t tube;     ///< index into Confusion::tubes
  std::size_t segment;  ///< index into Confusion::segments
  std::int64_t points;
};

/// The confusion matrix of ground truth and prediction: a row for each tube, a column for each segment. A
/// segment is the set of points to which the prediction gives the same label. Sparse, because few tubes and
/// segments overlap.
struct Confusion {
  std::vector<Region> tubes;      ///< from the ground truth, ascending by label, none empty
  std::vector<Region> segments;   ///< from the prediction, counting points on tubes only; ascending by label
  std::vector<Overlap> overlaps;  ///< the nonzero cells, row by row
};

/// Counts the points on tubes: those with label 1 or more in the ground truth. All others are ignored. Points
/// that the prediction labels 0 (the bin) or null belong to no segment. Throws std::invalid_argument if the
/// arrays differ in length.
Confusion count_overlaps(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted);

/// Intersection over union of an overlap's tube and segment.
double iou(const Confusion& confusion, const Overlap& overlap);

}  // namespace tanglebin
