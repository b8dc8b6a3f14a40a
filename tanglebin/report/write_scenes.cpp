#include "tanglebin/report/write_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "tanglebin/base/picked.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/report/scene_view.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

/// A cloud by how much it is to be shown: the smaller, the more.
struct Ranked {
  SeenCase seen;
  double rank;
};

std::vector<Ranked> ranked_by_recall(const std::vector<ScoredCase>& scores) {
  std::vector<Ranked> cases;
  cases.reserve(scores.size());
  for (const auto& [micro_recall, seen] : scores) cases.push_back({seen, micro_recall});
  return cases;
}

std::vector<Ranked> ranked_by_difference(const ResultsSummary& results, const std::vector<Entry>& methods) {
  std::map<SeenCase, std::pair<double, double>> extremes;
  for (const Entry& method : methods) {
    for (const auto& [micro_recall, seen] : results.scores(method.name)) {
      auto& [least, most] = extremes.try_emplace(seen, micro_recall, micro_recall).first->second;
      least = std::min(least, micro_recall);
      most = std::max(most, micro_recall);
    }
  }
  std::vector<Ranked> cases;
  for (const auto& [seen, range] : extremes) {
    if (range.first < range.second) cases.push_back({seen, range.first - range.second});
  }
  return cases;
}

void add_first(std::vector<Ranked> cases, std::size_t count, const std::string& reason,
               std::vector<SceneToShow>& scenes) {
  std::ranges::stable_sort(cases, {}, &Ranked::rank);
  cases.resize(std::min(cases.size(), count));
  for (const Ranked& ranked : cases) {
    auto scene = std::ranges::find(scenes, ranked.seen, &SceneToShow::seen);
    if (scene == scenes.end()) scene = scenes.insert(scene, {ranked.seen, {}});
    scene->reasons.push_back(reason);
  }
}

/// The parts of a case that a method scored, and what it found there.
class ShownCase {
public:
  ShownCase(const Dataset& dataset, const SceneToShow& scene, double ratio)
      : seen_(scene.seen),
        data_(read_seen_case(dataset, seen_)),
        scene_{.name = fmt::format("{}, ratio {} ({})", name_of(seen_), ratio_text(ratio),
                                   fmt::join(scene.reasons, ", ")),
               .cloud = {},
               .truth = {},
               .found = {},
               .support = {.bin = recipe_of(dataset, seen_.scene).bin}} {}

  /// The first method's filter chooses the points. The others' are the same, unless they were set apart.
  void add(const Entry& method, ModelAgain& model_again) {
    const std::optional<Model> model = model_again(method, seen_, data_);
    if (!model) return;
    if (!scene_.truth) choose_points(model->filtered);
    scene_.found.push_back(
        {.name = method.name, .labels = picked(model->labels, shown_), .tubes = model->tubes});
  }

  bool is_empty() const { return scene_.found.empty(); }

  std::string json() const { return scene_json(scene_, most_points_of_results); }

private:
  void choose_points(const std::vector<std::size_t>& filtered) {
    shown_ = filtered;
    scene_.cloud.points = picked(data_.cloud.points, shown_);
    scene_.cloud.width = shown_.size();
    scene_.truth = {.name = "truth",
                    .labels = picked(truth_labels(data_.cloud, data_.cloud_file), shown_),
                    .tubes = data_.tubes};
  }

  SeenCase seen_;
  CaseData data_;
  ViewedScene scene_;
  std::vector<std::size_t> shown_;
};

bool has_score(const std::vector<ScoredCase>& scores, const SeenCase& seen) {
  return std::ranges::find(scores, seen, &ScoredCase::seen) != scores.end();
}

}  // namespace

std::vector<SceneToShow> scenes_to_show(const ResultsSummary& results, const std::vector<Entry>& methods,
                                        std::size_t count) {
  std::vector<SceneToShow> scenes;
  for (const Entry& method : methods) {
    add_first(ranked_by_recall(results.scores(method.name)), count, "worst of " + method.name, scenes);
  }
  add_first(ranked_by_difference(results, methods), count, "methods differ", scenes);
  return scenes;
}

void write_scenes(const std::filesystem::path& directory, const Dataset& dataset,
                  const ExperimentSettings& settings, std::size_t count, ModelAgain& model_again) {
  const ResultsSummary results = summary_of(directory, settings.ratios);
  std::string lines;
  for (const SceneToShow& scene : scenes_to_show(results, settings.methods, count)) {
    ShownCase shown(dataset, scene, results.ratio());
    for (const Entry& method : settings.methods) {
      if (has_score(results.scores(method.name), scene.seen)) shown.add(method, model_again);
    }
    if (!shown.is_empty()) lines += shown.json() + '\n';
  }
  write_file(directory / "scenes.jsonl", lines);
}

}  // namespace tanglebin
