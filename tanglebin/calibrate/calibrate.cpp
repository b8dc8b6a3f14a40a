#include "tanglebin/calibrate/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/calibrate/calibration_scenes.hpp"
#include "tanglebin/calibrate/learn_links_once.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/versions.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/runs/interrupt_guard.hpp"
#include "tanglebin/scan/sensor.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Thrown when the budget is spent.
class BudgetSpent : public std::exception {};

std::string text_of(const Recipe& recipe) {
  return bytes_of([&](std::ostream& out) { write_recipe(out, recipe); });
}

// What the scores in a directory depend on.
Json claim_json(const Recipe& recipe, const CalibrationSettings& settings) {
  const ScoringSettings& scoring = settings.scoring;
  return {{"version", versions().at("tanglebin")},
          {"program_sha256", program_sha256()},
          {"method", name_of(scoring.method)},
          {"objective", name_of(scoring.objective)},
          {"ratio", scoring.ratio},
          {"time_limit", std::chrono::duration<double>(scoring.scene_limit).count()},
          {"scenes", settings.scenes},
          {"recipe", text_of(recipe)}};
}

// Throws InputError if the directory belongs to another calibration.
void claim_directory(const fs::path& directory, const Recipe& recipe, const CalibrationSettings& settings) {
  const fs::path file = directory / "calibration.json";
  const Json wanted = claim_json(recipe, settings);
  const std::optional<std::string> found = read_if_there(file);
  if (!found) {
    write_file(file, json_text(wanted) + '\n');
    return;
  }
  const JsonRecord record(*found, file.string(), 0);
  for (const auto& [key, value] : wanted.items()) {
    const Json its = record.json().value(key, Json());
    if (json_text(its) == json_text(value)) continue;
    throw InputError({file.string(), 0, key},
                     fmt::format("the directory belongs to another calibration: it has {}, this one {}; "
                                 "remove it or name another profile",
                                 json_text(its), json_text(value)));
  }
}

// Of tubes that differ from each other within a scene.
void widen_radii(TubesMadeFor& tubes, const std::vector<TubeSpec>& each_tube) {
  for (const TubeSpec& tube : each_tube) {
    tubes.radius_min = std::min(tubes.radius_min, tube.radius);
    tubes.radius_max = std::max(tubes.radius_max, tube.radius);
  }
}

// Each kind of tube in each set, from the least to the greatest that the scenes have.
std::vector<TubesMadeFor> tubes_of(const CalibrationScenes& scenes) {
  std::map<std::pair<std::string, std::size_t>, TubesMadeFor> by_kind;
  for (const CaseId& id : scenes.scenes) {
    const Recipe recipe = recipe_of(scenes.dataset, id);
    const std::vector<TubeKind> kinds = known_scene(recipe, id).kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      TubesMadeFor its{kinds[i].radius, kinds[i].radius, kinds[i].length_min, kinds[i].length()};
      if (kinds.size() == 1) widen_radii(its, set_named(recipe, id.set).each_tube);
      const auto [place, is_new] = by_kind.try_emplace({id.set, i}, its);
      if (is_new) continue;
      TubesMadeFor& all = place->second;
      all.radius_min = std::min(all.radius_min, its.radius_min);
      all.radius_max = std::max(all.radius_max, its.radius_max);
      all.length_min = std::min(all.length_min, its.length_min);
      all.length_max = std::max(all.length_max, its.length_max);
    }
  }
  std::vector<TubesMadeFor> tubes;
  for (const auto& [kind, its] : by_kind) {
    if (std::ranges::find(tubes, its) == tubes.end()) tubes.push_back(its);
  }
  return tubes;
}

// The preset that the first scanner is; empty if it is none.
std::string preset_of(const Recipe& recipe) {
  for (const std::string_view name : scanner_presets()) {
    const Camera camera = camera_preset(name);
    const bool is_camera = camera.width == recipe.camera.width && camera.fx == recipe.camera.fx;
    if (is_camera && sensor_preset(name) == recipe.sensor) return std::string(name);
  }
  return {};
}

MadeFor purpose_of(const Recipe& recipe, const CalibrationScenes& training) {
  return {.scanner = preset_of(recipe),
          .image_width = recipe.camera.width,
          .focal_length = recipe.camera.fx,
          .bin = recipe.bin,
          .recipe_sha256 = sha256(text_of(recipe)),
          .version = versions().at("tanglebin"),
          .program_sha256 = program_sha256(),
          .tubes = tubes_of(training)};
}

/// One calibration, from its scenes on.
class CalibrationRun {
public:
  CalibrationRun(const CalibrationSettings& settings, const fs::path& directory, const Journal& journal,
                 const CalibrationScenes& training, const CalibrationScenes& validation,
                 const CalibrationObserver& observer, Clock::time_point begun)
      : settings_(settings),
        directory_(directory),
        training_(training),
        observer_(observer),
        begun_(begun),
        workers_{.tick = [this] { report(); }, .stopping = observer.stopping},
        training_scores_("training", training.dataset, training.scenes, settings.scoring, journal, workers_),
        validation_scores_("validation", validation.dataset, validation.scenes, settings.scoring, journal,
                           workers_) {}

  Calibration result() {
    const Parameters best = found();
    const Reached reached = validated(best);
    const bool is_better = reached.difference.mean > 0;
    Calibration calibration{.profile = {.parameters = is_better ? best : settings_.start,
                                        .method = settings_.scoring.method,
                                        .reached = reached},
                            .sensitivities = std::move(sensitivities_),
                            .evaluations = training_scores_.asked(),
                            .is_better = is_better};
    if (!is_better) calibration.profile.reached = unchanged(reached);
    return calibration;
  }

private:
  // Throws BudgetSpent before a heat that would begin beyond the budget.
  std::vector<double> scores(const Parameters& parameters, const std::vector<std::size_t>& scenes) {
    if (is_searching_) expect_budget();
    std::vector<double> result = training_scores_.scores(parameters, scenes);
    if (race_) progress_.best = race_->score();
    return result;
  }

  void expect_budget() const {
    const CalibrationBudget& budget = settings_.budget;
    if (training_scores_.asked() >= budget.evaluations) throw BudgetSpent();
    if (budget.time && time_left() <= evaluations_of_the_end() * pace().value_or(Seconds{}))
      throw BudgetSpent();
  }

  Seconds time_left() const { return *settings_.budget.time - (Clock::now() - begun_); }

  // Of an evaluation in this call.
  std::optional<Seconds> pace() const {
    const std::size_t made = training_scores_.made() + validation_scores_.made();
    if (made == 0) return std::nullopt;
    return Seconds(Clock::now() - scored_since_) / static_cast<double>(made);
  }

  // What comes after the search, at most.
  double evaluations_of_the_end() const {
    const std::size_t changed = race_ ? groups_of_differences(race_->best(), settings_.start).size() : 0;
    return static_cast<double>(changed * training_scores_.scenes() + 2 * validation_scores_.scenes());
  }

  double evaluations_to_come() const {
    if (most_) return *most_ - static_cast<double>(progress_.evaluations);
    const auto budget = static_cast<double>(settings_.budget.evaluations);
    const double in_budget =
        budget - static_cast<double>(training_scores_.answered()) + evaluations_of_the_end();
    if (!settings_.budget.time || !pace()) return in_budget;
    return std::max(evaluations_of_the_end(), std::min(in_budget, time_left() / *pace()));
  }

  void report() {
    progress_.evaluations = training_scores_.answered() + validation_scores_.answered();
    const double to_come = std::max(0.0, evaluations_to_come());
    progress_.most = progress_.evaluations + static_cast<std::size_t>(to_come);
    progress_.left = pace() ? std::optional(to_come * *pace()) : std::nullopt;
    observer_.progress(progress_);
  }

  // The best parameters, for the scenes to calibrate on.
  Parameters found() {
    progress_.step = "scoring the start";
    const Scorer scorer = [this](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
      return scores(parameters, scenes);
    };
    Race& race = race_.emplace(scorer, training_scores_.scenes(), settings_.start);
    progress_.before = progress_.best = race.score();
    try {
      is_searching_ = true;
      improve(race);
    } catch (const BudgetSpent&) {
      // The best so far is what it comes to.
    }
    is_searching_ = false;
    most_ = static_cast<double>(training_scores_.asked()) + evaluations_of_the_end();
    progress_.step = "leaving out what does not help";
    keep_what_helps(race, settings_.start);
    return race.best();
  }

  void improve(Race& race) {
    if (settings_.scoring.method == Method::axis) {
      expect_budget();
      progress_.step = "learning the weights of links";
      race.run(with_links(settings_.start, learn_links_once(training_.dataset, training_.scenes,
                                                            directory_ / "links.toml", workers_)));
    }
    progress_.step = "tuning";
    tune(race, tunable_parameters(settings_.scoring.method),
         [&](const std::vector<Sensitivity>& seen) { sensitivities_ = seen; });
  }

  Reached validated(const Parameters& best) {
    progress_.step = "scoring the scenes that it was not calibrated on";
    const std::size_t count = validation_scores_.scenes();
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    const std::vector<double> before = validation_scores_.scores(settings_.start, all);
    const std::vector<double> after = validation_scores_.scores(best, all);
    std::vector<double> differences(count);
    std::ranges::transform(after, before, differences.begin(), std::minus());
    return {.objective = name_of(settings_.scoring.objective),
            .ratio = settings_.scoring.ratio,
            .scenes = static_cast<int>(count),
            .before = estimate_of_mean(before),
            .after = estimate_of_mean(after),
            .difference = estimate_of_mean(differences)};
  }

  static Reached unchanged(Reached reached) {
    reached.after = reached.before;
    reached.difference = {};
    return reached;
  }

  const CalibrationSettings& settings_;
  const fs::path& directory_;
  const CalibrationScenes& training_;
  const CalibrationObserver& observer_;
  Clock::time_point begun_;
  WorkersObserver workers_;
  SceneScores training_scores_;
  SceneScores validation_scores_;
  CalibrationProgress progress_{};
  std::optional<Race> race_{};
  std::vector<Sensitivity> sensitivities_{};
  Clock::time_point scored_since_ = Clock::now();
  bool is_searching_ = false;
  std::optional<double> most_{};  ///< evaluations, once the search is over
};

}  // namespace

std::optional<Calibration> calibrate(const Recipe& recipe, const CalibrationSettings& settings,
                                     const fs::path& directory, const CalibrationObserver& observer) {
  const Clock::time_point begun = Clock::now();
  const InterruptGuard guard;
  expect_available(settings.scoring.method);
  make_directories(directory);
  const Journal journal(directory);
  claim_directory(directory, recipe, settings);
  const auto scenes = [&](const std::string& part) {
    return make_scenes(recipe, part, settings.scenes, directory, settings.scoring.jobs, observer.scenes);
  };
  const std::optional<CalibrationScenes> training = scenes("training");
  if (!training) return std::nullopt;
  const std::optional<CalibrationScenes> validation = scenes("validation");
  if (!validation) return std::nullopt;
  try {
    CalibrationRun run(settings, directory, journal, *training, *validation, observer, begun);
    Calibration calibration = run.result();
    calibration.profile.made_for = purpose_of(recipe, *training);
    return calibration;
  } catch (const CalibrationStopped&) {
    return std::nullopt;
  }
}

}  // namespace tanglebin
