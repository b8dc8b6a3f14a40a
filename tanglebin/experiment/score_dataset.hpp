#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/experiment/run_failure.hpp"

namespace tanglebin {

/// The score of one cloud's labels.
struct SceneScore {
  SeenCase seen;
  std::optional<ModelScore> score{};  ///< of all points on tubes; none if it failed
  std::optional<RunFailure> failure{};
  bool repeats_truth = false;  ///< the labels are the cloud's own at every point: perhaps copied by mistake
};

/// Scores the labels of a case's cloud in a directory, whose files labels_sha256() lists. A case without
/// labels or with such that cannot be read has a failure. Throws InputError if there is no such directory,
/// and as read_seen_case() does.
SceneScore score_scene(const Dataset& dataset, const SeenCase& seen, const LabelsDirectory& labels);

/// The means over the scenes of a set with the same number of tubes, as a scanner sees them. A scene that
/// failed counts as one in which nothing was found; one without a visible tube does not count.
struct MeanScore {
  std::string set;
  std::string scanner;
  int tubes;
  std::size_t scenes = 0;
  std::size_t failed = 0;  ///< of these
  double micro_recall = 0;
  double mean_iou = 0;
  double f1 = 0;
  double panoptic_quality = 0;
  std::optional<double> adjusted_rand_index{};  ///< without scenes of one tube; none if all are
  std::size_t with_rand_index = 0;              ///< scenes that it is the mean of
};

/// Adds a scene to the means, which are in order of appearance.
void add(std::vector<MeanScore>& means, const SceneScore& scene);

}  // namespace tanglebin
