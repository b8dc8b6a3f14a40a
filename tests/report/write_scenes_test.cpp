#include "tanglebin/report/write_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tanglebin/experiment/run_experiment.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;

void add(ResultsSummary& summary, const std::string& method, int number, double recall, double ratio = 0.3) {
  summary.add({.run = {.method = method, .scene = {"A", 5, number}, .ratio = ratio},
               .case_sha256 = "",
               .micro_recall = recall});
}

TEST(WriteScenes, ShowsTheWorstOfEachMethodAndWhereTheyDifferMost) {
  ResultsSummary summary(0.3);
  add(summary, "axis", 1, 0.9);
  add(summary, "axis", 2, 0.7);
  add(summary, "axis", 3, 0.8);
  add(summary, "axis", 4, 0.99);
  add(summary, "axis", 1, 0.1, 0.5);
  add(summary, "paper", 1, 0.9);
  add(summary, "paper", 2, 0.6);
  add(summary, "paper", 3, 0.85);
  add(summary, "paper", 4, 0.65);
  add(summary, "paper", 5, 0.95);
  summary.add({.run = {.method = "axis", .scene = {"A", 5, 5}, .ratio = 0.3},
               .case_sha256 = "",
               .failure = RunFailure{.of = FailureOf::method, .reason = "no points"}});
  const auto scenes = scenes_to_show(summary, built_in_entries(), 1);
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0].seen.scene.number, 2);
  EXPECT_THAT(scenes[0].reasons, ElementsAre("worst of paper", "worst of axis"));
  EXPECT_EQ(scenes[1].seen.scene.number, 4);
  EXPECT_THAT(scenes[1].reasons, ElementsAre("methods differ"));
  EXPECT_TRUE(scenes_to_show(summary, built_in_entries(), 0).empty());
}

TEST(WriteScenes, EachSceneHasTheTruthAndWhatEveryMethodFound) {
  const test::SmallDataset directory;
  const test::TemporaryDirectory results;
  const Dataset dataset = directory.read();
  const ExperimentSettings settings{.methods = built_in_entries(), .ratios = {0.4}, .model = {.seed = 5}};
  run_experiment(dataset, settings, cases(dataset), results.path(), 2);
  ModelAgain model_again(results.path(), dataset, settings);
  write_scenes(results.path(), dataset, settings, 1, model_again);

  const std::string text = test::bytes_of(results / "scenes.jsonl");
  std::istringstream lines(text);
  std::string line;
  int scenes = 0;
  for (; std::getline(lines, line); ++scenes) {
    const auto scene = nlohmann::json::parse(line);
    EXPECT_TRUE(scene.at("has_truth"));
    EXPECT_GT(scene.at("points").at("count"), 100);
    ASSERT_EQ(scene.at("labellings").size(), 1 + methods().size());
    EXPECT_EQ(scene.at("labellings")[0].at("name"), "truth");
    for (std::size_t i = 0; i < methods().size(); ++i) {
      const auto& found = scene.at("labellings")[i + 1];
      EXPECT_EQ(found.at("name"), name_of(methods()[i]));
      const ResultsSummary summary = summary_of(results.path(), settings.ratios);
      const auto& scores = summary.scores(name_of(methods()[i]));
      const auto score = std::ranges::find_if(scores, [&](const ScoredCase& scored) {
        return scene.at("name").get<std::string>().starts_with(name_of(scored.seen) + ", ratio 0.4 (");
      });
      ASSERT_NE(score, scores.end());
      EXPECT_NEAR(found.at("score").at("micro_recall"), score->micro_recall, 1e-12) << "as in results.jsonl";
    }
  }
  EXPECT_GE(scenes, 1);
  write_scenes(results.path(), dataset, settings, 1, model_again);
  EXPECT_EQ(test::bytes_of(results / "scenes.jsonl"), text);
}

}  // namespace
}  // namespace tanglebin
