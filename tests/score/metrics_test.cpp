#include "tanglebin/score/metrics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/score/confusions.hpp"

namespace tanglebin {
namespace {

TEST(Detection, ComparesWithAHandMadeExample) {
  // IoU 80/120 and 60/100 detect tubes 1 and 2; 20/100, though all that there is of tube 3, does not.
  const Detection found = detection(confusion_with_null({{80, 0, 0, 0, 20},  //
                                                         {0, 60, 0, 0, 20},
                                                         {20, 20, 20, 10, 0},
                                                         {0, 0, 0, 0, 50}}));
  EXPECT_DOUBLE_EQ(found.precision, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(found.recall, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(found.f1, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(found.panoptic_quality, (80.0 / 120.0 + 60.0 / 100.0) / 4.0);
}

TEST(Detection, TakesMoreThanHalf) {
  EXPECT_EQ(detection(confusion_with_null({{50, 50}})).recall, 0.0);
  EXPECT_EQ(detection(confusion_with_null({{51, 50}})).recall, 1.0);
}

TEST(Detection, PrecisionCountsLabelsAndRecallTubes) {
  const Detection found = detection(confusion_with_null({{90, 5, 5, 0}}));
  EXPECT_DOUBLE_EQ(found.precision, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(found.recall, 1.0);
  EXPECT_DOUBLE_EQ(found.f1, 2 * (1.0 / 3.0) / (1.0 + 1.0 / 3.0));
  EXPECT_DOUBLE_EQ(found.panoptic_quality, 0.9 * found.f1);
}

TEST(Detection, WithoutLabelsIsZero) {
  const Detection found = detection(confusion_with_null({{10}, {20}}));
  EXPECT_EQ(found.precision, 0.0);
  EXPECT_EQ(found.recall, 0.0);
  EXPECT_EQ(found.f1, 0.0);
  EXPECT_EQ(found.panoptic_quality, 0.0);
}

double rand_index_of(const Labels& labels) {
  return adjusted_rand_index(count_overlaps(labels.truth, labels.predicted));
}

TEST(AdjustedRandIndex, ComparesWithHandMadeExamples) {
  // 1 pair together in both; 2 in the truth, 1 in the prediction, 6 in all: (1 − 1/3) / (3/2 − 1/3).
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 2, 2}, {1, 1, 2, 3}}), 4.0 / 7.0);
  // 0 in both; 2, 2 and 6: (0 − 2/3) / (2 − 2/3).
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 2, 2}, {1, 2, 1, 2}}), -0.5);
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 1, 1}, {1, 2, 3, 4}}), 0.0);
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 2, 2}, {7, 7, 5, 5}}), 1.0);
}

TEST(AdjustedRandIndex, NullPointsBelongTogetherWithNoOther) {
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 2, 2}, {1, 1, -1, -1}}), 4.0 / 7.0);
  EXPECT_DOUBLE_EQ(rand_index_of({{1, 1, 2, 2}, {-1, -1, -1, -1}}), 0.0);
}

TEST(AdjustedRandIndex, OfThoseWhoAgreeOnATrivialMatterIsOne) {
  EXPECT_EQ(rand_index_of({{1}, {1}}), 1.0);
  EXPECT_EQ(rand_index_of({{3, 3, 3}, {2, 2, 2}}), 1.0);
  EXPECT_EQ(rand_index_of({{1, 2, 3}, {3, 1, 2}}), 1.0);
}

// Pair by pair: it is Cohen's kappa of the 2 x 2 table of pairs (Warrens 2008).
double rand_index_by_pairs(const Labels& labels) {
  double both = 0.0;
  double truth_only = 0.0;
  double predicted_only = 0.0;
  double neither = 0.0;
  for (std::size_t i = 0; i < labels.truth.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (labels.truth[i] < 1 || labels.truth[j] < 1) continue;
      const bool in_truth = labels.truth[i] == labels.truth[j];
      const bool in_prediction = labels.predicted[i] == labels.predicted[j] && labels.predicted[i] > 0;
      (in_truth ? (in_prediction ? both : truth_only) : (in_prediction ? predicted_only : neither)) += 1.0;
    }
  }
  if (truth_only + predicted_only == 0.0) return 1.0;
  return 2 * (both * neither - truth_only * predicted_only) /
         ((both + truth_only) * (truth_only + neither) +
          (both + predicted_only) * (predicted_only + neither));
}

RC_GTEST_PROP(AdjustedRandIndex, IsThatOfItsPairs, ()) {
  const Labels labels = *any_labels();
  const double difference = rand_index_of(labels) - rand_index_by_pairs(labels);
  RC_ASSERT(std::abs(difference) < 1e-12);
}

TEST(Instances, ACutTubeIsOverSegmented) {
  const Instances counts = count_instances(confusion_with_null({{40, 50, 10}}));
  EXPECT_EQ(counts.over_segmented, 1U);
  EXPECT_EQ(counts.correct, 0U);
  EXPECT_EQ(counts.missed, 0U);
  EXPECT_EQ(counts.noise, 0U);
}

TEST(Instances, MergedTubesAreUnderSegmented) {
  const Instances counts = count_instances(confusion_with_null({{90, 10}, {60, 40}}));
  EXPECT_EQ(counts.under_segmented, 1U);
  EXPECT_EQ(counts.correct, 0U);
  EXPECT_EQ(counts.missed, 0U);
  EXPECT_EQ(counts.noise, 0U);
}

TEST(Instances, ATubeThatIsMostlyNullIsMissedAndItsLabelNoise) {
  const Instances counts = count_instances(confusion_with_null({{100, 0, 0}, {0, 50, 50}}));
  EXPECT_EQ(counts.correct, 1U);
  EXPECT_EQ(counts.missed, 1U);
  EXPECT_EQ(counts.noise, 1U);
}

TEST(Instances, ALabelAcrossThreeTubesIsNoise) {
  const Instances counts =
      count_instances(confusion_with_null({{60, 0, 0, 20, 0}, {0, 60, 0, 20, 0}, {0, 0, 60, 20, 0}}));
  EXPECT_EQ(counts.correct, 3U);
  EXPECT_EQ(counts.noise, 1U);
  EXPECT_EQ(counts.missed, 0U);
}

TEST(Instances, TheBestFitCounts) {
  // A tube and its label, (0.9 + 1) / 2, or the same tube cut into two, (0.95 + 1) / 2.
  EXPECT_EQ(count_instances(confusion_with_null({{90, 5, 5}})).over_segmented, 1U);
  // The second label has most of its points elsewhere: (0.9 + 1) / 2 remains, and the second tube's
  // (1 + 6/11) / 2.
  const Instances apart = count_instances(confusion_with_null({{90, 5, 5}, {0, 6, 0}}));
  EXPECT_EQ(apart.correct, 2U);
  EXPECT_EQ(apart.over_segmented, 0U);
  // Two labels on one tube, (0.8 + 100/105) / 2, or the larger with the smaller tube it merges in, (1 +
  // 105/125) / 2?
  const Instances merged = count_instances(confusion_with_null({{100, 20}, {5, 0}}));
  EXPECT_EQ(merged.under_segmented, 1U);
  EXPECT_EQ(merged.correct, 0U);
}

RC_GTEST_PROP(Instances, NoTubeOrLabelCountsTwice, ()) {
  const Labels labels = *any_labels();
  const Confusion confusion = count_overlaps(labels.truth, labels.predicted);
  const Instances counts = count_instances(confusion);
  RC_ASSERT(counts.correct + counts.over_segmented + 2 * counts.under_segmented + counts.missed <=
            confusion.tubes.size());
  RC_ASSERT(counts.correct + 2 * counts.over_segmented + counts.under_segmented + counts.noise <=
            confusion.segments.size());
}

}  // namespace
}  // namespace tanglebin
