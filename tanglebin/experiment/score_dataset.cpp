#include "tanglebin/experiment/score_dataset.hpp"

#include <algorithm>
#include <numeric>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/verify_case.hpp"
#include "tanglebin/experiment/modelled.hpp"

namespace tanglebin {

namespace {

// 0 for a scene that failed, unless it is of one tube.
std::optional<double> rand_index_of(const SceneScore& scene) {
  if (scene.score) return scene.score->labels.adjusted_rand_index;
  if (scene.seen.scene.tubes == 1) return std::nullopt;
  return 0;
}

}  // namespace

SceneScore score_scene(const Dataset& dataset, const SeenCase& seen, const LabelsDirectory& labels) {
  expect_there(labels, {1});
  const CaseData data = read_seen_case(dataset, seen);
  SceneScore scene{.seen = seen};
  scene.failure = failure_of_scene(data.cloud.labels);
  if (scene.failure) return scene;
  try {
    const Entry entry{"labels", labels};
    const KnownScene known = known_scene(recipe_seen(dataset, seen), seen.scene);
    const RunId run{entry.name, seen.scene, 1, seen.scanner};
    Modelled modelled = model_by(entry, known, data, run, {.ratios = {1}}, {});
    modelled.model.filtered.resize(data.cloud.points.size());
    std::iota(modelled.model.filtered.begin(), modelled.model.filtered.end(), std::size_t{0});
    scene.repeats_truth = modelled.model.labels == data.cloud.labels;
    scene.score = score_model(data, modelled.model, modelled.has_tubes);
  } catch (const InputError& error) {
    scene.failure = {FailureOf::method, complaint_of(error)};
  }
  return scene;
}

void add(std::vector<MeanScore>& means, const SceneScore& scene) {
  if (scene.failure && scene.failure->of == FailureOf::scene) return;
  const auto& [id, scanner] = scene.seen;
  auto mean = std::ranges::find_if(means, [&its = scene.seen](const MeanScore& other) {
    return other.set == its.scene.set && other.scanner == its.scanner && other.tubes == its.scene.tubes;
  });
  if (mean == means.end()) mean = means.insert(mean, {.set = id.set, .scanner = scanner, .tubes = id.tubes});
  ++mean->scenes;
  if (!scene.score) ++mean->failed;
  const auto include = [&](double& mean_value, double value) {
    mean_value += (value - mean_value) / static_cast<double>(mean->scenes);
  };
  const Score score = scene.score ? scene.score->labels : Score{};
  include(mean->micro_recall, score.micro_recall);
  include(mean->mean_iou, score.mean_iou);
  include(mean->f1, score.detection.f1);
  include(mean->panoptic_quality, score.detection.panoptic_quality);
  if (const auto rand_index = rand_index_of(scene)) {
    ++mean->with_rand_index;
    const double before = mean->adjusted_rand_index.value_or(0);
    mean->adjusted_rand_index = before + (*rand_index - before) / static_cast<double>(mean->with_rand_index);
  }
}

}  // namespace tanglebin
