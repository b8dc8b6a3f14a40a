#include "tanglebin/experiment/measures.hpp"

namespace tanglebin {
Json measures_json(const Score& score) {
  return {{"micro_recall", score.micro_recall},
          {"points", score.points},
          {"correct_points", score.correct_points},
          {"null_points", score.null_points},
          {"mean_iou", score.mean_iou},
          {"precision", score.detection.precision},
          {"recall", score.detection.recall},
          {"f1", score.detection.f1},
          {"panoptic_quality", score.detection.panoptic_quality},
          {"adjusted_rand_index", number_or_null(score.adjusted_rand_index)},
          {"unmixed_recall", number_or_null(score.unmixed_recall)},
          {"correct", score.instances.correct},
          {"over_segmented", score.instances.over_segmented},
          {"under_segmented", score.instances.under_segmented},
          {"missed", score.instances.missed},
          {"noise", score.instances.noise}};
}

Json measures_json(const TubesScore& score) {
  return {{"centre_line_error", number_or_null(score.centre_line_error)},
          {"centre_line_error_p95", number_or_null(score.centre_line_error_p95)},
          {"centre_line_coverage", score.centre_line_coverage},
          {"complete_tubes", score.complete_tubes},
          {"length_error", number_or_null(score.length_error)},
          {"true_joins", score.true_joins},
          {"joins_found", score.joins_found},
          {"joins_made", score.joins_made},
          {"true_junctions", score.true_junctions},
          {"junctions_found", score.junctions_found},
          {"junctions_made", score.junctions_made}};
}

Json tube_json(const TubeScore& tube) {
  return {{"label", tube.label},
          {"points", tube.points},
          {"assigned", number_or_null(tube.assigned)},
          {"correct_points", tube.correct_points},
          {"null_points", tube.null_points},
          {"iou", tube.iou}};
}

}  // namespace tanglebin
