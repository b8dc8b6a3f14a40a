#include "tanglebin/calibrate/scene_scores.hpp"

#include <fmt/format.h>

#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/experiment/given_cloud.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/model/parameters.hpp"

namespace tanglebin {
namespace {

ModelSettings settings_with(const Parameters& parameters) {
  ModelSettings settings;
  for (const auto& [name, value] : parameters) set_parameter(settings, name, value);
  return settings;
}

double score_of_cloud(const CaseData& data, const KnownScene& known, const RunId& run,
                      const ScoringSettings& settings, const ModelSettings& model_settings) {
  const ExperimentSettings experiment{.methods = {}, .ratios = {}, .model = model_settings};
  try {
    Model model = model_case(known, data, run, experiment);
    model.filtered = seen_points(data.cloud, known, run.ratio, model_seed(experiment, run.scene)).scored;
    return value_of(settings.objective, data, score_model(data, model));
  } catch (const InputError&) {
    return 0;
  }
}

double score_of_scene(const Dataset& dataset, const CaseId& id, const ScoringSettings& settings,
                      const ModelSettings& model_settings) {
  const std::vector<Scanner> all = scanners(dataset.recipe);
  double sum = 0;
  for (const Scanner& scanner : all) {
    const SeenCase seen{id, scanner.name};
    const CaseData data = read_seen_case(dataset, seen);
    const KnownScene known = known_scene(recipe_seen(dataset, seen), id);
    const RunId run{name_of(settings.method), id, settings.ratio, scanner.name};
    sum += score_of_cloud(data, known, run, settings, model_settings);
  }
  return sum / static_cast<double>(all.size());
}

std::map<std::string, double> numbers_in(const JsonRecord& record) {
  std::map<std::string, double> numbers;
  for (const std::string& name : record.fields()) numbers.emplace(name, record.number(name));
  return numbers;
}

}  // namespace

SceneScores::SceneScores(std::string part, const Dataset& dataset, std::vector<CaseId> scenes,
                         const ScoringSettings& settings, const Journal& journal, WorkersObserver observer)
    : part_(std::move(part)),
      dataset_(dataset),
      scenes_(std::move(scenes)),
      settings_(settings),
      journal_(journal),
      observer_(std::move(observer)) {
  read_journal();
}

std::vector<double> SceneScores::scores(const Parameters& parameters,
                                        const std::vector<std::size_t>& scenes) {
  std::vector<CaseId> missing;
  for (const std::size_t scene : scenes) {
    const Key key{parameters, name_of(scenes_[scene])};
    asked_.insert(key);
    if (!known_.contains(key)) missing.push_back(scenes_[scene]);
  }
  if (!missing.empty()) make(parameters, missing);
  std::vector<double> scores;
  scores.reserve(scenes.size());
  for (const std::size_t scene : scenes) scores.push_back(known_.at({parameters, name_of(scenes_[scene])}));
  return scores;
}

void SceneScores::read_journal() {
  for_each_readable_line(journal_.file(), [&](const std::string& line, std::size_t number) {
    const JsonRecord record(line, journal_.file().string(), number);
    if (record.text("part") != part_) return;
    const Parameters parameters = numbers_in(record.object("parameters"));
    for (const auto& [scene, score] : numbers_in(record.object("scores")))
      known_[{parameters, scene}] = score;
  });
}

void SceneScores::make(const Parameters& parameters, const std::vector<CaseId>& scenes) {
  const ModelSettings model_settings = settings_with(parameters);
  const auto score = [&](std::size_t task) {
    return fmt::format("{}", score_of_scene(dataset_, scenes[task], settings_, model_settings));
  };
  std::map<std::string, double> made;
  awaited_ = scenes.size();
  const auto take = [&](std::size_t task, double value) {
    made[name_of(scenes[task])] = value;
    --awaited_;
    ++made_;
  };
  WorkersObserver observer = observer_;
  observer.done = [&](const std::vector<TaskResult>& results) {
    for (const auto& [task, text, seconds] : results) {
      const bool is_in_time = seconds <= std::chrono::duration<double>(settings_.scene_limit).count();
      take(task, is_in_time ? to_number<double>(text).value_or(0) : 0);
    }
  };
  observer.failed = [&](const TaskFailure& failure) { take(failure.task, 0); };
  const bool is_done = run_in_workers(settings_.jobs, scenes.size(), score, observer, settings_.scene_limit);
  keep(parameters, made);
  if (!is_done) throw CalibrationStopped();
}

void SceneScores::keep(const Parameters& parameters, const std::map<std::string, double>& scores) {
  journal_.append(
      {json_text(Json{{"part", part_}, {"parameters", Json(parameters)}, {"scores", Json(scores)}})});
  for (const auto& [scene, score] : scores) known_[{parameters, scene}] = score;
}

}  // namespace tanglebin
