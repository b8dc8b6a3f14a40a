#include "tanglebin/experiment/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/score/score.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

using test::SmallDataset;
using test::TemporaryDirectory;
using testing::HasSubstr;

PointCloud cloud_of(const std::vector<std::int32_t>& labels) {
  PointCloud cloud;
  cloud.labels = labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    cloud.points.emplace_back(static_cast<float>(i) / 100, 0.0F, 0.0F);
  }
  cloud.width = labels.size();
  return cloud;
}

std::vector<Tube> tubes(int count) {
  std::vector<Tube> result(static_cast<std::size_t>(count));
  for (int id = 1; id <= count; ++id) {
    Tube& tube = result[static_cast<std::size_t>(id - 1)];
    tube.id = id;
    tube.radius = 0.0125;
    const double y = 0.1 * id;
    tube.nodes = {{1, {0, y, 0}}, {2, {0.5, y, 0}}};
    tube.edges = {{0, 1, 1}};
  }
  return result;
}

TEST(KnownScene, HasEachKindOfTubesOfItsSet) {
  Recipe recipe = test::small_recipe();
  std::vector<TubeSpec>& kinds = recipe.sets[0].kinds;
  kinds.resize(3);
  kinds[1].radius = 0.008;
  kinds[1].segments.resize(3);
  for (int i = 0; i < 3; ++i) {
    SegmentSpec& arm = kinds[1].segments[static_cast<std::size_t>(i)];
    arm.to = i + 2;
    arm.length = 0.1;
  }
  kinds[2].radius = kinds[0].radius;
  kinds[2].segments[0].length = 0.6;
  const KnownScene known = known_scene(recipe, {"A", 3, 1});
  ASSERT_EQ(known.kinds.size(), 2U);
  EXPECT_EQ(known.kinds[0].radius, 0.0125);
  EXPECT_EQ(known.kinds[0].length(), 0.6) << "the longest of those with this radius";
  EXPECT_FALSE(known.kinds[0].branches());
  EXPECT_EQ(known.kinds[1].radius, 0.008);
  EXPECT_NEAR(known.kinds[1].length(), 0.3, 1e-12);
  EXPECT_EQ(count_ends(known.kinds[1].segments), 3);
}

TEST(KnownScene, KnowsKindsOfTubesNotEachTube) {
  Recipe recipe = test::small_recipe();
  TubeSpec other = recipe.sets[0].kinds[0];
  other.radius = 0.011;
  recipe.sets[0].each_tube = {other, other, other};
  const KnownScene known = known_scene(recipe, {"A", 3, 1});
  ASSERT_EQ(known.kinds.size(), 1U);
  EXPECT_EQ(known.kinds[0].radius, recipe.sets[0].kinds[0].radius);
}

TEST(KnownScene, OfARandomRecipeHasTheNumbersOfTheCase) {
  std::istringstream text(R"(
[scanner]
look_at = [0, 0, 0]
distance = 2
tilt_deg = 20
azimuth_deg = { min = 0, max = 360 }
[[set]]
name = "A"
tubes = [3]
tube = { radius = { min = 0.01, max = 0.02 }, mass = 0.5, length = 0.5, bend_max_deg = 30 }
)");
  const Recipe recipe = read_recipe(text, "recipe.toml");
  const CaseId id{"A", 3, 2};
  const Recipe own = resolve(recipe, id, draw(recipe, id));
  const KnownScene known = known_scene(recipe, id);
  EXPECT_EQ(known.camera, own.camera);
  EXPECT_NE(known.camera, recipe.camera);
  EXPECT_EQ(known.kinds.at(0).radius, own.sets[0].kinds[0].radius);
}

TEST(KnownScene, KnowsTheRangeOfLengthsThatDifferFromTubeToTube) {
  Recipe recipe = test::small_recipe();
  std::vector<TubeSpec> tubes(3, recipe.sets[0].kinds[0]);
  const double middle = tubes[1].segments[0].length;
  tubes[0].segments[0].length = 0.75 * middle;
  tubes[2].segments[0].length = 1.5 * middle;
  recipe.sets[0].each_tube = tubes;
  const KnownScene known = known_scene(recipe, {"A", 3, 1});
  ASSERT_EQ(known.kinds.size(), 1U);
  EXPECT_EQ(known.kinds[0].length_min, 0.75 * middle);
  EXPECT_EQ(known.kinds[0].length(), 1.5 * middle);
}

TEST(ScoreModel, LooksAtThePointsThatTheFilterLeftAlone) {
  const CaseData data{"1.ply", cloud_of({0, 1, 1, 1, 2, 2}), tubes(2)};
  const Model model{.tubes = tubes(2), .labels = {1, 2, 2, -1, 1, -1}, .filtered = {0, 1, 2, 4}, .steps = {}};
  const ModelScore score = score_model(data, model);
  EXPECT_EQ(score.labels.points, 3);
  EXPECT_FALSE(score_model(data, model, false).tubes.has_value());
  EXPECT_EQ(score.labels.micro_recall, 1.0);
}

TEST(ScoreModel, ACloudOfWhichTheFilterLeavesNoTubeIsAnErrorThatNamesIt) {
  const CaseData data{"1.ply", cloud_of({0, 1}), tubes(1)};
  const Model model{.tubes = {}, .labels = {0, -1}, .filtered = {0}, .steps = {}};
  try {
    score_model(data, model);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "1.ply: no point on a tube is left after filtering");
  }
}

TEST(ComparedClouds, GiveAnAssignedTubeTheTrueTubesLabelAndTheOthersNewOnes) {
  const CaseData data{"1.ply", cloud_of({0, 1, 1, 1, 2, 2, 2, 2}), tubes(2)};
  const Model model{
      .tubes = tubes(4), .labels = {0, 2, 2, 4, 3, 3, -1, 1}, .filtered = {0, 1, 2, 3, 4, 5, 6}, .steps = {}};
  const ComparedClouds clouds = compared_clouds(data, model);
  EXPECT_EQ(clouds.truth.labels, (std::vector<std::int32_t>{0, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(clouds.labels.labels, (std::vector<std::int32_t>{0, 1, 1, 4, 2, 2, -1}));
  EXPECT_EQ(clouds.truth.points, clouds.labels.points);
  EXPECT_EQ(clouds.truth.points.size(), 7U);
}

TEST(ResultJson, HasTheScoresOfTheModelComputedDirectly) {
  const SmallDataset directory;
  const Dataset dataset = directory.read();
  const RunId run{"paper", {"A", 3, 1}, 1.0};
  const CaseData data = read_case(dataset, run.scene);
  const Model model = model_case(known_scene(recipe_of(dataset, run.scene), run.scene), data, run,
                                 {.ratios = {}, .model = {.seed = 5}});

  std::vector<std::int32_t> truth;
  std::vector<std::int32_t> labels;
  for (const std::size_t i : model.filtered) {
    truth.push_back(data.cloud.labels[i]);
    labels.push_back(model.labels[i]);
  }
  const Score expected = score(truth, labels);
  const TubesScore expected_tubes = score_tubes(data.tubes, model.tubes);

  const Modelled modelled{.model = model, .seconds = 1.5};
  const auto json = nlohmann::json::parse(
      result_json(run, dataset.catalogue.record(run.scene), modelled, score_model(data, model)));
  EXPECT_GT(expected.micro_recall, 0);
  EXPECT_EQ(json.at("points"), expected.points);
  EXPECT_EQ(json.at("micro_recall").get<double>(), expected.micro_recall);
  EXPECT_EQ(json.at("mean_iou").get<double>(), expected.mean_iou);
  EXPECT_EQ(json.at("f1").get<double>(), expected.detection.f1);
  EXPECT_EQ(json.at("panoptic_quality").get<double>(), expected.detection.panoptic_quality);
  EXPECT_EQ(json.at("adjusted_rand_index").get<double>(), expected.adjusted_rand_index);
  EXPECT_EQ(json.at("correct"), expected.instances.correct);
  EXPECT_EQ(json.at("noise"), expected.instances.noise);
  EXPECT_EQ(json.at("correct_points"), expected.correct_points);
  ASSERT_EQ(json.at("each_tube").size(), expected.tubes.size());
  EXPECT_EQ(json.at("each_tube").at(1).at("iou").get<double>(), expected.tubes[1].iou);
  EXPECT_EQ(json.at("tubes_found"), model.tubes.size());
  EXPECT_EQ(json.at("centre_line_error").is_null(), !expected_tubes.centre_line_error.has_value());
  EXPECT_EQ(json.at("centre_line_coverage").get<double>(), expected_tubes.centre_line_coverage);
  EXPECT_EQ(json.at("true_joins"), expected_tubes.true_joins);
  EXPECT_EQ(json.at("counts").size(), model.steps.size());
  const Step& first = model.steps.at(0);
  EXPECT_EQ(json.at("counts").at(first.name), first.count);
  const auto json_of_times = nlohmann::json::parse(times_json(run, modelled, {"Z80", 2, 0.5}));
  EXPECT_EQ(json_of_times.at("steps").at(first.name).get<double>(), first.seconds);
  EXPECT_EQ(json_of_times.at("seconds"), 1.5);
  EXPECT_EQ(json_of_times.at("processor"), "Z80");
  EXPECT_EQ(json_of_times.at("jobs"), 2);
  EXPECT_EQ(json_of_times.at("load"), 0.5);
}

TEST(ModelCase, ModelsTheSameAgainAndAnotherSeedAnother) {
  const SmallDataset directory;
  const Dataset dataset = directory.read();
  const RunId run{"paper", {"A", 3, 1}, 0.8};
  const CaseData data = read_case(dataset, run.scene);
  const auto model = [&](std::uint64_t seed) {
    return model_case(known_scene(recipe_of(dataset, run.scene), run.scene), data, run,
                      {.ratios = {}, .model = {.seed = seed}});
  };
  EXPECT_EQ(model(1).labels, model(1).labels);
  EXPECT_NE(model(1).filtered, model(2).filtered);
}

}  // namespace
}  // namespace tanglebin
