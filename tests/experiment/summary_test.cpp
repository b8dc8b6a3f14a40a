#include "tanglebin/experiment/summary.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

RunResult result(const CaseId& id, double ratio, double micro_recall) {
  return {{Method::paper, id, ratio}, "", micro_recall, std::nullopt, ""};
}

RunResult failed(const CaseId& id, double ratio, FailureOf of) {
  return {{Method::paper, id, ratio}, "", 0, RunFailure{of, "why"}, ""};
}

TEST(RatioToShow, IsTheNearestToThatOfThePapersFigure) {
  EXPECT_EQ(ratio_to_show({0.1, 0.2, 0.3, 0.4}), 0.3);
  EXPECT_EQ(ratio_to_show({0.5, 1}), 0.5);
  EXPECT_EQ(ratio_to_show({0.2, 0.4}), 0.2);
  EXPECT_EQ(ratio_to_show({1}), 1);
}

TEST(MeanMicroRecalls, AreOverTheCasesOfASetAndNumberOfTubesAtOneRatio) {
  const auto means = mean_micro_recalls(
      {result({"A", 1, 1}, 0.3, 0.5), result({"A", 1, 1}, 0.4, 0.9), result({"A", 1, 2}, 0.3, 1.0),
       result({"A", 5, 1}, 0.3, 0.25), result({"B", 1, 1}, 0.3, 0.125)},
      0.3);
  ASSERT_EQ(means.size(), 3U);
  EXPECT_EQ(means[0].mean, 0.75);
  EXPECT_EQ(means[0].cases, 2U);
  EXPECT_EQ(means[1].tubes, 5);
  EXPECT_EQ(means[1].mean, 0.25);
  EXPECT_EQ(means[2].set, "B");
  EXPECT_EQ(means[2].mean, 0.125);
}

TEST(MeanMicroRecalls, AFailedRunIsAZeroAndACaseWithoutAVisibleTubeNone) {
  const std::vector<RunResult> results = {
      result({"A", 1, 1}, 0.3, 0.5), failed({"A", 1, 2}, 0.3, FailureOf::method),
      failed({"A", 1, 3}, 0.3, FailureOf::worker), failed({"A", 1, 4}, 0.3, FailureOf::scene),
      failed({"A", 1, 4}, 0.4, FailureOf::scene)};
  const auto means = mean_micro_recalls(results, 0.3);
  ASSERT_EQ(means.size(), 1U);
  EXPECT_EQ(means[0].cases, 3U);
  EXPECT_EQ(means[0].failed, 2U);
  EXPECT_DOUBLE_EQ(means[0].mean, 0.5 / 3);
  EXPECT_EQ(count_failures(results).failed_runs, 2U);
  EXPECT_EQ(count_failures(results).cases_unscored, 1U);
}

TEST(Examples, AreOfRunsThatDidNotFail) {
  const auto found = examples({failed({"A", 1, 1}, 0.3, FailureOf::method), result({"A", 1, 2}, 0.3, 0.2)},
                              Method::paper, 0.3);
  ASSERT_EQ(found.size(), 3U);
  for (const Example& example : found) EXPECT_EQ(example.result.run.scene.number, 2);
}

TEST(Examples, AreTheBestTheMedianAndTheWorstAndOfEqualsTheFirst) {
  const auto found =
      examples({result({"A", 1, 1}, 0.3, 0.5), result({"A", 1, 2}, 0.3, 0.9), result({"A", 1, 3}, 0.3, 0.2),
                result({"A", 1, 4}, 0.3, 0.9), result({"A", 1, 5}, 0.3, 0.2), result({"A", 1, 6}, 0.4, 1.0)},
               Method::paper, 0.3);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].rank, "best");
  EXPECT_EQ(found[0].result.run.scene.number, 2);
  EXPECT_EQ(found[1].rank, "median");
  EXPECT_EQ(found[1].result.run.scene.number, 1);
  EXPECT_EQ(found[2].rank, "worst");
  EXPECT_EQ(found[2].result.run.scene.number, 3);
}

TEST(Examples, OfNoRunsAreNone) {
  EXPECT_TRUE(examples({result({"A", 1, 1}, 0.3, 0.5)}, Method::paper, 0.4).empty());
}

}  // namespace
}  // namespace tanglebin
