#include "tanglebin/experiment/summary.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tanglebin {
namespace {

RunResult result(const CaseId& id, double ratio, double micro_recall) {
  return {.run = {"paper", id, ratio}, .case_sha256 = "", .micro_recall = micro_recall};
}

RunResult failed(const CaseId& id, double ratio, FailureOf of) {
  return {.run = {"paper", id, ratio}, .case_sha256 = "", .failure = RunFailure{of, "why"}};
}

// At a ratio of 0.3.
ResultsSummary summary_of(const std::vector<RunResult>& results, double ratio = 0.3) {
  ResultsSummary summary(ratio);
  for (const RunResult& result : results) summary.add(result);
  return summary;
}

TEST(RatioToShow, IsTheNearestToThatOfThePapersFigure) {
  EXPECT_EQ(ratio_to_show({0.1, 0.2, 0.3, 0.4}), 0.3);
  EXPECT_EQ(ratio_to_show({0.5, 1}), 0.5);
  EXPECT_EQ(ratio_to_show({0.2, 0.4}), 0.2);
  EXPECT_EQ(ratio_to_show({1}), 1);
}

TEST(MeanMicroRecalls, AreOverTheCasesOfASetAndNumberOfTubesAtOneRatio) {
  const auto means =
      summary_of({result({"A", 1, 1}, 0.3, 0.5), result({"A", 1, 1}, 0.4, 0.9), result({"A", 1, 2}, 0.3, 1.0),
                  result({"A", 5, 1}, 0.3, 0.25), result({"B", 1, 1}, 0.3, 0.125)})
          .means();
  ASSERT_EQ(means.size(), 3U);
  EXPECT_EQ(means[0].mean, 0.75);
  EXPECT_EQ(means[0].cases, 2U);
  EXPECT_EQ(means[1].tubes, 5);
  EXPECT_EQ(means[1].mean, 0.25);
  EXPECT_EQ(means[2].set, "B");
  EXPECT_EQ(means[2].mean, 0.125);
}

TEST(MeanMicroRecalls, AFailedRunIsAZeroAndACaseWithoutAVisibleTubeNone) {
  const ResultsSummary summary =
      summary_of({result({"A", 1, 1}, 0.3, 0.5), failed({"A", 1, 2}, 0.3, FailureOf::method),
                  failed({"A", 1, 3}, 0.3, FailureOf::worker), failed({"A", 1, 4}, 0.3, FailureOf::scene),
                  failed({"A", 1, 4}, 0.4, FailureOf::scene)});
  const auto& means = summary.means();
  ASSERT_EQ(means.size(), 1U);
  EXPECT_EQ(means[0].cases, 3U);
  EXPECT_EQ(means[0].failed, 2U);
  EXPECT_DOUBLE_EQ(means[0].mean, 0.5 / 3);
  EXPECT_EQ(summary.failures().failed_runs, 2U);
  EXPECT_EQ(summary.failures().cases_unscored, 1U);
}

TEST(Examples, AreOfRunsThatDidNotFail) {
  const auto found = summary_of({failed({"A", 1, 1}, 0.3, FailureOf::method), result({"A", 1, 2}, 0.3, 0.2)})
                         .examples("paper");
  ASSERT_EQ(found.size(), 3U);
  for (const Example& example : found) EXPECT_EQ(example.seen.scene.number, 2);
}

TEST(Examples, AreTheBestTheMedianAndTheWorstAndOfEqualsTheFirst) {
  const auto found = summary_of({result({"A", 1, 1}, 0.3, 0.5), result({"A", 1, 2}, 0.3, 0.9),
                                 result({"A", 1, 3}, 0.3, 0.2), result({"A", 1, 4}, 0.3, 0.9),
                                 result({"A", 1, 5}, 0.3, 0.2), result({"A", 1, 6}, 0.4, 1.0)})
                         .examples("paper");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].rank, "best");
  EXPECT_EQ(found[0].seen.scene.number, 2);
  EXPECT_EQ(found[1].rank, "median");
  EXPECT_EQ(found[1].seen.scene.number, 1);
  EXPECT_EQ(found[2].rank, "worst");
  EXPECT_EQ(found[2].seen.scene.number, 3);
}

TEST(Examples, OfNoRunsAreNone) {
  EXPECT_TRUE(summary_of({result({"A", 1, 1}, 0.3, 0.5)}, 0.4).examples("paper").empty());
}

}  // namespace
}  // namespace tanglebin
