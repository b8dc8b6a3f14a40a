#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/score/confusion.hpp"
#include "tanglebin/score/metrics.hpp"

namespace tanglebin {

/// A tube, with the label that was assigned to it.
struct TubeScore {
  std::int32_t label;
  std::int64_t points;
  std::optional<std::int32_t> assigned;  ///< M(C): the predicted label assigned to it, if any
  std::int64_t correct_points;           ///< tp: its points with that label
  std::int64_t null_points;              ///< its points without a predicted label
  double iou;                            ///< of the tube and that label's segment; 0 if there is none
};

/// How well a prediction labels the points on tubes. docs/metrics.md defines every measure. All are in [0,
/// 1], the adjusted Rand index in [−1, 1]; higher is better.
struct Score {
  double micro_recall;  ///< Equation (1): correct_points / points
  std::int64_t points;
  std::int64_t correct_points;
  std::int64_t null_points;
  double mean_iou;  ///< over all tubes, found or not
  Detection detection;
  std::optional<double> adjusted_rand_index;  ///< none for one tube: it would say nothing
  /// Micro-recall without the mixed points, which lie between surfaces; none if they are not marked, or all
  /// are mixed.
  std::optional<double> unmixed_recall;
  Instances instances;
  std::vector<TubeScore> tubes;  ///< ascending by label
  Confusion confusion;
};

/// Scores a label for each point. In the ground truth, labels from 1 are tubes; all other points are ignored.
/// In the prediction, 0 and null mean no tube; otherwise the label values do not matter. `mixed` marks mixed
/// points (PointCloud::mixed), if it is not empty. Throws std::invalid_argument if the arrays differ in
/// length, or if the ground truth has no point on a tube.
Score score(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted,
            const std::vector<std::uint8_t>& mixed = {});

}  // namespace tanglebin
