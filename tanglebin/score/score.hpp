#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/score/confusion.hpp"
#include "tanglebin/score/metrics.hpp"

namespace tanglebin {

/// A tube and the label that the assignment gave it.
struct TubeScore {
  std::int32_t label;
  std::int64_t points;
  std::optional<std::int32_t> assigned;  ///< M(C): the predicted label that stands for it, if any
  std::int64_t correct_points;           ///< tp: its points with that label
  std::int64_t null_points;              ///< its points that no label claims
  double iou;                            ///< of the tube and that label's segment, 0 without one
};

/// How well a prediction labels the points of tubes. docs/metrics.md defines every measure. All are in [0,
/// 1], the adjusted Rand index in [−1, 1]; higher is better.
struct Score {
  double micro_recall;  ///< Equation (1): correct_points / points
  std::int64_t points;
  std::int64_t correct_points;
  std::int64_t null_points;
  double mean_iou;  ///< of all tubes, found or not
  Detection detection;
  double adjusted_rand_index;
  Instances instances;
  std::vector<TubeScore> tubes;  ///< ascending by label
  Confusion confusion;
};

/// The score of one label for each point. In the truth 1 and above are tubes, and all other points are left
/// out; in the prediction 0 and null claim no tube, and what else the labels are does not matter. Throws
/// std::invalid_argument for arrays of different lengths, or where the truth has no point on a tube.
Score score(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted);

}  // namespace tanglebin
