#include "tanglebin/calibrate/calibrate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tanglebin/calibrate/calibration_scenes.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tests/experiment/small_dataset.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::complaint;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::AllOf;
using testing::Ge;
using testing::Gt;
using testing::HasSubstr;
using testing::Le;
using testing::Lt;

constexpr int few_scenes = 4;

CalibrationSettings quick(std::size_t evaluations) {
  return {.scenes = few_scenes, .budget = {.evaluations = evaluations}};
}

std::string text_of_profile(const Profile& profile) {
  std::ostringstream text;
  write_profile(text, profile, "calibrated");
  return std::move(text).str();
}

std::string first_lines(const std::string& text, std::ptrdiff_t count) {
  std::istringstream in(text);
  std::string line;
  std::string result;
  while (count-- > 0 && std::getline(in, line)) result += line + '\n';
  return result;
}

TEST(Calibration, GivesTheSameProfileWhereverItWasInterrupted) {
  const TemporaryDirectory directory;
  const Recipe recipe = test::finely_seen_recipe();
  const std::optional<Calibration> whole = calibrate(recipe, quick(40), directory / "run");
  ASSERT_TRUE(whole);
  const std::filesystem::path journal = directory / "run/journal.jsonl";
  const std::string lines = bytes_of(journal);
  // As a kill leaves it: with a line that is not whole.
  write_bytes(journal, first_lines(lines, 5) + R"({"part":"trai)");
  const std::optional<Calibration> resumed = calibrate(recipe, quick(40), directory / "run");
  ASSERT_TRUE(resumed);
  EXPECT_EQ(text_of_profile(resumed->profile), text_of_profile(whole->profile));
  EXPECT_EQ(resumed->evaluations, whole->evaluations);
}

TEST(Calibration, ModelsNothingTwice) {
  const TemporaryDirectory directory;
  const Recipe recipe = test::finely_seen_recipe();
  calibrate(recipe, quick(30), directory / "run");
  const std::string lines = bytes_of(directory / "run/journal.jsonl");
  calibrate(recipe, quick(30), directory / "run");
  EXPECT_EQ(bytes_of(directory / "run/journal.jsonl"), lines);
}

TEST(Calibration, IsForTubesAsDifferentAsThoseOfItsScenes) {
  const TemporaryDirectory directory;
  Recipe recipe = test::finely_seen_recipe();
  recipe.sets[0].tubes = {3};
  recipe.random = {{"set[0].tube.radius", RandomNumber{.min = 0.01, .max = 0.013, .per_tube = true}},
                   {"set[0].tube.length", RandomNumber{.min = 0.4, .max = 0.5, .per_tube = true}}};
  const std::optional<Calibration> calibration = calibrate(recipe, quick(4), directory / "run");
  ASSERT_TRUE(calibration);
  ASSERT_EQ(calibration->profile.made_for->tubes.size(), 1U);
  const TubesMadeFor& tubes = calibration->profile.made_for->tubes[0];
  EXPECT_THAT(tubes.radius_min, AllOf(Ge(0.01), Lt(0.011)));
  EXPECT_THAT(tubes.radius_max, AllOf(Gt(0.012), Le(0.013)));
  EXPECT_THAT(tubes.length_min, AllOf(Ge(0.4), Lt(0.43)));
  EXPECT_THAT(tubes.length_max, AllOf(Gt(0.47), Le(0.5)));
}

TEST(Calibration, SaysWhatTheProfileIsForAndWhatItReached) {
  const TemporaryDirectory directory;
  const Recipe recipe = test::finely_seen_recipe();
  const std::optional<Calibration> calibration = calibrate(recipe, quick(20), directory / "run");
  ASSERT_TRUE(calibration);
  const Profile& profile = calibration->profile;
  EXPECT_EQ(profile.method, Method::axis);
  EXPECT_EQ(profile.made_for->bin, recipe.bin);
  EXPECT_EQ(profile.made_for->image_width, 480);
  EXPECT_EQ(profile.made_for->scanner, "");  // no preset has so few pixels
  ASSERT_EQ(profile.made_for->tubes.size(), 1U);
  EXPECT_EQ(profile.made_for->tubes[0].radius_max, 0.0125);
  EXPECT_EQ(profile.reached->objective, "unmixed_recall");
  EXPECT_EQ(profile.reached->scenes, few_scenes);
  EXPECT_GT(profile.reached->before.mean, 0.5);
}

TEST(Calibration, NeverGivesAProfileThatIsWorseThanTheDefaults) {
  const TemporaryDirectory directory;
  const std::optional<Calibration> calibration =
      calibrate(test::finely_seen_recipe(), quick(40), directory / "run");
  ASSERT_TRUE(calibration);
  const Reached& reached = *calibration->profile.reached;
  EXPECT_GE(reached.after.mean, reached.before.mean);
  EXPECT_EQ(calibration->is_better, reached.difference.mean > 0);
  EXPECT_EQ(calibration->is_better, !calibration->profile.parameters.empty());
}

TEST(Calibration, ComesBackFromAStartThatFindsNothing) {
  const TemporaryDirectory directory;
  CalibrationSettings settings{.scenes = 2, .budget = {.evaluations = 240}};
  settings.start = {{"axis.fragment.points_min", 2000}};
  const std::optional<Calibration> calibration =
      calibrate(test::finely_seen_recipe(), settings, directory / "run");
  ASSERT_TRUE(calibration);
  EXPECT_LT(calibration->profile.reached->before.mean, 0.5);
  EXPECT_GT(calibration->profile.reached->after.mean, 0.9);
}

TEST(Calibration, DoesNotShareADirectoryWithAnother) {
  const TemporaryDirectory directory;
  calibrate(test::finely_seen_recipe(), quick(10), directory / "run");
  CalibrationSettings other = quick(10);
  other.scoring.ratio = 0.5;
  EXPECT_THAT(complaint([&] { calibrate(test::finely_seen_recipe(), other, directory / "run"); }),
              AllOf(HasSubstr("calibration.json: ratio: the directory belongs to another calibration"),
                    HasSubstr("it has 1.0, this one 0.5")));
}

TEST(Calibration, SaysIfARecipeHasNoValidScene) {
  const TemporaryDirectory directory;
  Recipe recipe = test::finely_seen_recipe();
  recipe.attempts = 1;
  recipe.settle.time_limit = 0.01;
  EXPECT_THAT(complaint([&] { calibrate(recipe, quick(10), directory / "run"); }),
              HasSubstr("no valid scene: "));
}

TEST(Calibration, SaysIfNoSceneShowsATube) {
  const TemporaryDirectory directory;
  Recipe recipe = test::finely_seen_recipe(50);
  EXPECT_THAT(complaint([&] { calibrate(recipe, quick(10), directory / "run"); }),
              HasSubstr("no scene shows a tube to the scanner"));
}

TEST(CalibrationScenes, AreNoneOfTheRecipesOwnAndDifferFromPartToPart) {
  const Recipe recipe = test::finely_seen_recipe();
  const Recipe training = recipe_of_part(recipe, "training", few_scenes);
  const Recipe validation = recipe_of_part(recipe, "validation", few_scenes);
  EXPECT_NE(training.seed, recipe.seed);
  EXPECT_NE(validation.seed, recipe.seed);
  EXPECT_NE(training.seed, validation.seed);
}

TEST(CalibrationScenes, AreSpreadOverTheNumbersOfTubes) {
  const TemporaryDirectory directory;
  const auto made = make_scenes(test::finely_seen_recipe(), "training", few_scenes, directory.path(), 1, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(std::ranges::count(made->scenes, 1, &CaseId::tubes), few_scenes / 2);
  EXPECT_EQ(std::ranges::count(made->scenes, 3, &CaseId::tubes), few_scenes / 2);
}

TEST(CalibrationScenes, AreSpreadOverTheNumbersOfTubesIfTheyAreFewer) {
  const TemporaryDirectory directory;
  Recipe recipe = test::finely_seen_recipe();
  recipe.sets[0].tubes = {1, 2, 3, 4};
  const auto made = make_scenes(recipe, "training", 2, directory.path(), 1, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(std::ranges::count(made->scenes, 1, &CaseId::tubes), 1);
  EXPECT_EQ(std::ranges::count(made->scenes, 3, &CaseId::tubes), 1);
}

TEST(SceneScores, CountAFailureAsZero) {
  const TemporaryDirectory directory;
  const auto made = make_scenes(test::finely_seen_recipe(), "training", 2, directory.path(), 1, {});
  const Journal journal(directory.path());
  const ScoringSettings settings;
  SceneScores scores("training", made->dataset, made->scenes, settings, journal, {});
  EXPECT_THAT(scores.scores({{"axis.fragment.points_min", 1e6}}, {0, 1}), testing::ElementsAre(0, 0));
  EXPECT_EQ(scores.asked(), 2U);
}

TEST(SceneScores, CountASceneThatTakesTooLongAsZero) {
  const TemporaryDirectory directory;
  const auto made = make_scenes(test::finely_seen_recipe(), "training", 2, directory.path(), 1, {});
  const Journal journal(directory.path());
  const ScoringSettings settings{.scene_limit = std::chrono::nanoseconds(1)};
  SceneScores scores("training", made->dataset, made->scenes, settings, journal, {});
  EXPECT_THAT(scores.scores({}, {0, 1}), testing::ElementsAre(0, 0));
}

TEST(SceneScores, AreNoBetterIfTheFilterDropsTubes) {
  const TemporaryDirectory directory;
  const auto made = make_scenes(test::finely_seen_recipe(), "training", 2, directory.path(), 1, {});
  const Journal journal(directory.path());
  const ScoringSettings settings;
  SceneScores scores("training", made->dataset, made->scenes, settings, journal, {});
  // Most points of a tube on the floor are nearer to it than this.
  EXPECT_LT(scores.scores({{"axis.filter.margin", 0.02}}, {0})[0], 0.95);
}

// What a scanner blends between two surfaces is on neither.
TEST(SceneScores, DoNotBlameParametersForMixedPoints) {
  const TemporaryDirectory directory;
  Recipe recipe = test::finely_seen_recipe();
  recipe.camera = downward_camera(1920, 1200, focal_length_from_hfov(1920, 1.22), {0, 0, 2});
  recipe.sensor = sensor_preset("phoxi");
  recipe.sensor.footprint = 3;
  recipe.sensor.working_distance = 2;
  const auto made = make_scenes(recipe, "training", 2, directory.path(), 1, {});
  const auto score_by = [&](Objective objective) {
    const Journal journal(directory.path(), name_of(objective));
    const ScoringSettings settings{.objective = objective};
    SceneScores scores("training", made->dataset, made->scenes, settings, journal, {});
    return scores.scores({}, {0})[0];
  };
  EXPECT_GT(score_by(Objective::unmixed_recall), 0.999);
  EXPECT_LT(score_by(Objective::micro_recall), 0.995);
}

TEST(Objectives, AreFoundByTheirNames) {
  for (const Objective objective : objectives()) EXPECT_EQ(objective_named(name_of(objective)), objective);
  EXPECT_THAT(
      complaint([] { objective_named("f1"); }),
      HasSubstr(
          "found 'f1', expected one of unmixed_recall, micro_recall, panoptic_quality, complete_tubes"));
}

}  // namespace
}  // namespace tanglebin
