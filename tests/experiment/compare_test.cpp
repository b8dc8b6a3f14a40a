#include "tanglebin/experiment/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/support/complaint.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using test::TemporaryDirectory;
using testing::HasSubstr;

/// A results directory with the micro-recalls that it is told; the other measures are half of them. If it is
/// told a recall without mixed points, they are marked.
class Results {
public:
  explicit Results(const std::vector<std::string>& methods, const std::string& recipe = "r") {
    nlohmann::json experiment{{"methods", methods}, {"ratios", {0.3, 1}}, {"recipe_sha256", recipe}};
    test::write_bytes(directory_ / "experiment.json", experiment.dump());
  }

  void add(const std::string& method, int number, double ratio, double micro_recall,
           std::optional<double> unmixed_recall = std::nullopt) {
    nlohmann::json line = head(method, number, ratio);
    line["micro_recall"] = micro_recall;
    for (const char* measure : {"mean_iou", "f1", "panoptic_quality", "adjusted_rand_index"})
      line[measure] = micro_recall / 2;
    line["unmixed_recall"] = nullptr;
    if (unmixed_recall) line["unmixed_recall"] = *unmixed_recall;
    write(line);
  }

  void add_of_one_tube(const std::string& method, int number, double micro_recall) {
    nlohmann::json line = head(method, number, 1);
    line["tubes"] = 1;
    for (const char* measure : {"micro_recall", "mean_iou", "f1", "panoptic_quality"})
      line[measure] = micro_recall;
    line["adjusted_rand_index"] = nullptr;
    line["unmixed_recall"] = nullptr;
    write(line);
  }

  void add_failure(const std::string& method, int number, double ratio, const std::string& of = "method") {
    nlohmann::json line = head(method, number, ratio);
    line["failure_of"] = of;
    line["failure"] = "why";
    write(line);
  }

  Contestant of(const std::string& method) const { return {path(), method}; }
  std::filesystem::path path() const { return directory_.path(); }

private:
  static nlohmann::json head(const std::string& method, int number, double ratio) {
    return {{"set", "A"},       {"tubes", 5},     {"case", number},
            {"method", method}, {"ratio", ratio}, {"case_sha256", "of " + std::to_string(number)}};
  }

  void write(const nlohmann::json& line) {
    text_ += line.dump() + '\n';
    test::write_bytes(directory_ / "results.jsonl", text_);
  }

  TemporaryDirectory directory_;
  std::string text_;
};

TEST(Compare, PairsScenesAndCountsTheMeanOverTheirRatios) {
  Results before({"axis"});
  Results after({"axis"});
  before.add("axis", 1, 0.3, 0.5);
  before.add("axis", 1, 1, 0.75);
  before.add("axis", 2, 0.3, 0.5);
  before.add("axis", 3, 0.3, 0.25);
  after.add("axis", 1, 0.3, 0.75);
  after.add("axis", 1, 1, 1);
  after.add("axis", 2, 0.3, 0.25);
  after.add("axis", 3, 0.3, 0.25);
  after.add("axis", 3, 1, 1);
  const Comparison comparison = compare(before.of("axis"), after.of("axis"));
  EXPECT_EQ(comparison.scenes, 3U);
  EXPECT_EQ(comparison.unpaired, 1U);
  const MeasureDifference& recall = comparison.measures.at(0);
  EXPECT_EQ(recall.measure, "micro_recall");
  EXPECT_DOUBLE_EQ(recall.baseline, (0.625 + 0.5 + 0.25) / 3);
  EXPECT_DOUBLE_EQ(recall.other, (0.875 + 0.25 + 0.25) / 3);
  EXPECT_NEAR(recall.difference, 0, 1e-12);
  EXPECT_NEAR(comparison.measures.at(1).other, recall.other / 2, 1e-12);
  ASSERT_EQ(comparison.better.size(), 1U);
  EXPECT_EQ(comparison.better[0].scene.number, 1);
  EXPECT_EQ(comparison.better[0].difference(), 0.25);
  ASSERT_EQ(comparison.worse.size(), 1U);
  EXPECT_EQ(comparison.worse[0].scene.number, 2);
}

TEST(Compare, TakesTheMicroRecallForThatWithoutMixedPointsWhereNoneAreMarked) {
  Results results({"axis", "mine"});
  results.add("axis", 1, 0.3, 0.5, 0.75);
  results.add("mine", 1, 0.3, 0.5, 1);
  results.add("axis", 2, 0.3, 0.25);
  results.add("mine", 2, 0.3, 0.5);
  const MeasureDifference without_mixed = compare(results.of("axis"), results.of("mine")).measures.at(5);
  EXPECT_EQ(without_mixed.measure, "unmixed_recall");
  EXPECT_DOUBLE_EQ(without_mixed.baseline, 0.5);
  EXPECT_DOUBLE_EQ(without_mixed.other, 0.75);
}

TEST(Compare, SaysNothingOfMixedPointsThatNoCloudMarks) {
  Results results({"axis", "mine"});
  for (const char* method : {"axis", "mine"}) results.add(method, 1, 0.3, 0.5);
  for (const MeasureDifference& measure : compare(results.of("axis"), results.of("mine")).measures)
    EXPECT_NE(measure.measure, "unmixed_recall");
}

TEST(Compare, LeavesScenesOfOneTubeOutOfTheRandIndex) {
  Results results({"axis", "mine"});
  const auto rand_indices = [&] {
    std::vector<MeasureDifference> found = compare(results.of("axis"), results.of("mine")).measures;
    std::erase_if(found, [](const auto& measure) { return measure.measure != "adjusted_rand_index"; });
    return found;
  };
  results.add_of_one_tube("axis", 1, 0.5);
  results.add_of_one_tube("mine", 1, 1);
  EXPECT_TRUE(rand_indices().empty());
  results.add("axis", 2, 1, 0.5);
  results.add("mine", 2, 1, 1);
  ASSERT_EQ(rand_indices().size(), 1U);
  EXPECT_EQ(rand_indices()[0].baseline, 0.25);
  EXPECT_EQ(rand_indices()[0].other, 0.5);
}

TEST(Compare, NamesADirectoryThatIsMissingAndAMethodThatIsNotThere) {
  Results results({"axis"});
  results.add("axis", 1, 0.3, 0.5);
  EXPECT_THAT(complaint([&] {
                compare(results.of("axis"), {"/nowhere", "axis"});
              }),
              HasSubstr("/nowhere/experiment.json"));
  EXPECT_THAT(complaint([&] { compare(results.of("axis"), results.of("mine")); }),
              HasSubstr("method: found 'mine', expected one of its methods"));
}

TEST(Compare, AFailedRunFoundNothingAndASceneWithoutAVisibleTubeDoesNotCount) {
  Results results({"axis", "mine"});
  for (const int number : {1, 2}) results.add("axis", number, 0.3, 0.5);
  results.add("mine", 1, 0.3, 0.5);
  results.add_failure("mine", 2, 0.3);
  results.add_failure("axis", 3, 0.3, "scene");
  results.add_failure("mine", 3, 0.3, "scene");
  const Comparison comparison = compare(results.of("axis"), results.of("mine"));
  EXPECT_EQ(comparison.scenes, 2U);
  EXPECT_EQ(comparison.measures[0].other, 0.25);
  EXPECT_EQ(comparison.worse.at(0).other, 0);
}

TEST(Compare, TheIntervalIsThatOfTheMeanDifferenceAndAlwaysTheSame) {
  Results before({"axis"});
  Results after({"axis"});
  constexpr int scenes = 400;
  for (int number = 1; number <= scenes; ++number) {
    before.add("axis", number, 1, 0.5);
    after.add("axis", number, 1, 0.5 + 0.01 + (number % 2 == 0 ? 0.1 : -0.1));
  }
  const Comparison comparison = compare(before.of("axis"), after.of("axis"));
  const MeasureDifference& recall = comparison.measures[0];
  // Of the mean of 400 with a standard deviation of 0.1: 1.96 · 0.1 / 20 to both sides.
  EXPECT_NEAR(recall.difference, 0.01, 1e-12);
  EXPECT_NEAR(recall.low, 0.01 - 0.0098, 0.001);
  EXPECT_NEAR(recall.high, 0.01 + 0.0098, 0.001);
  const MeasureDifference again = compare(before.of("axis"), after.of("axis")).measures[0];
  EXPECT_EQ(again.low, recall.low);
  EXPECT_EQ(again.high, recall.high);
}

TEST(Compare, OfTheSameResultsThereIsNoDifference) {
  Results results({"axis"});
  for (const int number : {1, 2, 3}) results.add("axis", number, 0.3, 0.1 * number);
  const Comparison comparison = compare(results.of("axis"), results.of("axis"));
  EXPECT_EQ(comparison.measures[0].low, 0);
  EXPECT_EQ(comparison.measures[0].high, 0);
  EXPECT_TRUE(comparison.better.empty() && comparison.worse.empty());
}

TEST(PairsToCompare, AreTheMethodsOfOneDirectoryOrTheSameMethodsOfSeveral) {
  const Results one({"paper", "axis", "mine"});
  const Results two({"axis", "paper"});
  const Results lonely({"mine"});
  const Results other_lonely({"yours"});
  const auto names = [](const std::vector<std::filesystem::path>& paths,
                        const std::optional<std::string>& baseline) {
    std::string text;
    for (const auto& [first, second] : pairs_to_compare(paths, baseline))
      text += first.method + "-" + second.method + " ";
    return text;
  };
  EXPECT_EQ(names({one.path()}, {}), "paper-axis paper-mine ");
  EXPECT_EQ(names({one.path()}, "axis"), "axis-paper axis-mine ");
  EXPECT_EQ(names({one.path(), two.path()}, {}), "paper-paper axis-axis ");
  EXPECT_EQ(names({one.path(), two.path(), lonely.path()}, {}), "paper-paper axis-axis mine-mine ");
  EXPECT_EQ(names({one.path(), two.path()}, "axis"), "axis-axis ");
  EXPECT_EQ(names({lonely.path(), other_lonely.path()}, {}), "mine-yours ");
}

TEST(PairsToCompare, OfOtherDatasetsOrWithNothingInCommonAreErrors) {
  const Results one({"axis"});
  const Results of_another({"axis"}, "other");
  EXPECT_THAT(complaint([&] {
                pairs_to_compare({one.path(), of_another.path()}, {});
              }),
              HasSubstr("recipe_sha256: results of another dataset"));
  EXPECT_THAT(complaint([&] { pairs_to_compare({one.path()}, {}); }), HasSubstr("no two methods to compare"));
  EXPECT_THAT(complaint([&] { pairs_to_compare({one.path()}, "mine"); }),
              HasSubstr("baseline: found 'mine', expected a method of " + one.path().string() + ": axis"));
  EXPECT_THAT(complaint([&] { pairs_to_compare({"/nowhere"}, {}); }), HasSubstr("/nowhere/experiment.json"));
  EXPECT_THAT(complaint([&] { compare(one.of("axis"), one.of("axis")); }), HasSubstr("no scene in common"));
}

}  // namespace
}  // namespace tanglebin
