#include "tanglebin/score/score.hpp"

#include <cstddef>
#include <map>
#include <stdexcept>

#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/score/assign.hpp"

namespace tanglebin {
namespace {

std::vector<TubeScore> tube_scores(const Confusion& confusion, const Assignment& assignment) {
  std::vector<TubeScore> tubes;
  tubes.reserve(confusion.tubes.size());
  for (const auto& [label, points] : confusion.tubes) tubes.push_back({label, points, {}, 0, points, 0.0});
  for (const Overlap& overlap : confusion.overlaps) {
    TubeScore& tube = tubes[overlap.tube];
    tube.null_points -= overlap.points;
    if (assignment[overlap.tube] != overlap.segment) continue;
    tube.assigned = confusion.segments[overlap.segment].label;
    tube.correct_points = overlap.points;
    tube.iou = iou(confusion, overlap);
  }
  return tubes;
}

// Of the points that are not mixed, the share that has the label assigned to its tube.
std::optional<double> unmixed_recall(const std::vector<TubeScore>& tubes,
                                     const std::vector<std::int32_t>& truth,
                                     const std::vector<std::int32_t>& predicted,
                                     const std::vector<std::uint8_t>& mixed) {
  if (mixed.empty()) return std::nullopt;
  if (mixed.size() != truth.size()) throw std::invalid_argument("not a mark of mixed points for each label");
  std::map<std::int32_t, std::optional<std::int32_t>> assigned;
  for (const TubeScore& tube : tubes) assigned[tube.label] = tube.assigned;
  std::int64_t points = 0;
  std::int64_t correct = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] <= bin_label || mixed[i] != 0) continue;
    ++points;
    if (assigned[truth[i]] == predicted[i]) ++correct;
  }
  if (points == 0) return std::nullopt;
  return static_cast<double>(correct) / static_cast<double>(points);
}

}  // namespace

Score score(const std::vector<std::int32_t>& truth, const std::vector<std::int32_t>& predicted,
            const std::vector<std::uint8_t>& mixed) {
  Score score{};
  score.confusion = count_overlaps(truth, predicted);
  if (score.confusion.tubes.empty()) throw std::invalid_argument("the ground truth has no point on a tube");
  score.tubes = tube_scores(score.confusion, assign(score.confusion));
  for (const TubeScore& tube : score.tubes) {
    score.points += tube.points;
    score.correct_points += tube.correct_points;
    score.null_points += tube.null_points;
    score.mean_iou += tube.iou;
  }
  score.mean_iou /= static_cast<double>(score.tubes.size());
  // Equation (1): tp + fn of a tube is the number of its points.
  score.micro_recall = static_cast<double>(score.correct_points) / static_cast<double>(score.points);
  score.detection = detection(score.confusion);
  if (score.tubes.size() > 1) score.adjusted_rand_index = adjusted_rand_index(score.confusion);
  score.unmixed_recall = unmixed_recall(score.tubes, truth, predicted, mixed);
  score.instances = count_instances(score.confusion);
  return score;
}

}  // namespace tanglebin
