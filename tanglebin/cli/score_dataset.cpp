#include "tanglebin/cli/score_dataset.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/experiment/measures.hpp"
#include "tanglebin/experiment/score_dataset.hpp"
#include "tanglebin/recipe/case_json.hpp"

namespace tanglebin::cli {
namespace {

void print_scene_json(const SceneScore& scene) {
  nlohmann::ordered_json json = id_json(scene.seen.scene);
  if (!scene.seen.scanner.empty()) json["scanner"] = scene.seen.scanner;
  if (scene.failure) add_failure(json, *scene.failure);
  if (scene.score) {
    json.update(measures_json(scene.score->labels));
    if (scene.score->tubes) json.update(measures_json(*scene.score->tubes));
  }
  print_json_line(json);
}

std::string text_of(const std::optional<double>& rand_index) {
  return rand_index ? fmt::format("{:.4f}", *rand_index) : "–";
}

void print_scene(const SceneScore& scene) {
  if (scene.failure) {
    print_out("{:<12} {}\n", name_of(scene.seen), scene.failure->reason);
    return;
  }
  const Score& score = scene.score->labels;
  print_out("{:<12} {:>12.4f} {:>9.4f} {:>7.4f} {:>7.4f} {:>7}\n", name_of(scene.seen), score.micro_recall,
            score.mean_iou, score.detection.f1, score.detection.panoptic_quality,
            text_of(score.adjusted_rand_index));
}

void print_means_json(const std::vector<MeanScore>& means) {
  nlohmann::ordered_json json{{"means", nlohmann::ordered_json::array()}};
  for (const MeanScore& mean : means) {
    json["means"].push_back({{"set", mean.set},
                             {"scanner", mean.scanner},
                             {"tubes", mean.tubes},
                             {"scenes", mean.scenes},
                             {"failed", mean.failed},
                             {"micro_recall", mean.micro_recall},
                             {"mean_iou", mean.mean_iou},
                             {"f1", mean.f1},
                             {"panoptic_quality", mean.panoptic_quality},
                             {"adjusted_rand_index", number_or_null(mean.adjusted_rand_index)}});
  }
  print_json_line(json);
}

void print_means(const std::vector<MeanScore>& means) {
  print_out("\n{:<6} {:>5} {:>6} {:>6} {:>12} {:>9} {:>7} {:>7} {:>7}\n", "set", "tubes", "scenes", "failed",
            "micro-recall", "mean IoU", "F1", "PQ", "ARI");
  for (const MeanScore& mean : means) {
    print_out("{:<6} {:>5} {:>6} {:>6} {:>12.4f} {:>9.4f} {:>7.4f} {:>7.4f} {:>7}\n",
              seen_by(mean.scanner, mean.set), mean.tubes, mean.scenes, mean.failed, mean.micro_recall,
              mean.mean_iou, mean.f1, mean.panoptic_quality, text_of(mean.adjusted_rand_index));
  }
}

}  // namespace

void score_dataset(const std::string& directory, const std::string& labels, bool json) {
  expect_dataset(directory);
  const Dataset dataset = read_dataset(directory);
  expect_clouds(dataset);
  if (!json)
    print_out("{:<12} {:>12} {:>9} {:>7} {:>7} {:>7}\n", "scene", "micro-recall", "mean IoU", "F1", "PQ",
              "ARI");
  std::vector<MeanScore> means;
  std::size_t failed = 0;
  std::vector<bool> repeats_truth;  // of each scene with several tubes; of one, the labels are often right
  for (const CaseId& id : cases(dataset)) {
    for (const Scanner& scanner : scanners(dataset.recipe)) {
      const SceneScore scene = score_scene(dataset, {id, scanner.name}, {labels});
      (json ? print_scene_json : print_scene)(scene);
      add(means, scene);
      if (scene.score && scene.score->labels.tubes.size() > 1) repeats_truth.push_back(scene.repeats_truth);
      if (scene.failure && scene.failure->of == FailureOf::method) ++failed;
    }
  }
  (json ? print_means_json : print_means)(means);
  if (!repeats_truth.empty() && std::ranges::all_of(repeats_truth, std::identity()))
    print_error(
        "tanglebin: warning: {}: its labels are the truth's own at every point of every scene; are they the "
        "result to score?\n",
        labels);
  if (failed > 0) throw CLI::RuntimeError(exit_cases_failed);
}

}  // namespace tanglebin::cli
