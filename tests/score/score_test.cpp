#include "tanglebin/score/score.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "tests/score/confusions.hpp"

namespace tanglebin {
namespace {

Score score_of(const Labels& labels) {
  return score(labels.truth, labels.predicted);
}

Score score_of(const Counts& counts_with_null) {
  return score_of(labels_with_null(counts_with_null));
}

TEST(Score, OfThePapersWorkedExampleIs50Of72) {
  // Section 5, Figures 4 and 5: two tubes, three labels and null. The text has the sum 26 + 2 + 11 and 24 + 2
  // + 7.
  const Score paper = score_of(Counts{{26, 2, 0, 11}, {0, 24, 2, 7}});
  EXPECT_EQ(paper.points, 72);
  EXPECT_EQ(paper.correct_points, 50);
  EXPECT_EQ(paper.null_points, 18);
  EXPECT_DOUBLE_EQ(paper.micro_recall, 50.0 / 72.0);
  EXPECT_EQ(paper.tubes.at(0).assigned, 1);
  EXPECT_EQ(paper.tubes.at(1).assigned, 2);
  EXPECT_DOUBLE_EQ(paper.tubes.at(0).iou, 26.0 / 39.0);
  EXPECT_DOUBLE_EQ(paper.tubes.at(1).iou, 24.0 / 35.0);
  EXPECT_DOUBLE_EQ(paper.mean_iou, (26.0 / 39.0 + 24.0 / 35.0) / 2);
  EXPECT_DOUBLE_EQ(paper.detection.precision, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(paper.detection.recall, 1.0);
}

TEST(Score, NullIsNeverAssigned) {
  const Score mostly_null = score_of(Counts{{1, 99}});
  EXPECT_EQ(mostly_null.tubes.at(0).assigned, 1);
  EXPECT_EQ(mostly_null.correct_points, 1);
  EXPECT_EQ(mostly_null.null_points, 99);
}

TEST(Score, WithoutMixedPointsIsThatOfTheOthers) {
  const std::vector<std::int32_t> truth = {1, 1, 1, 1, 2, 2, 0};
  const std::vector<std::int32_t> predicted = {7, 7, 0, 9, 9, 9, 9};
  EXPECT_EQ(score(truth, predicted).unmixed_recall, std::nullopt);
  const Score marked = score(truth, predicted, {0, 0, 1, 1, 0, 1, 0});
  EXPECT_DOUBLE_EQ(marked.micro_recall, 4.0 / 6.0);
  EXPECT_EQ(marked.unmixed_recall, 1.0);
  EXPECT_EQ(score(truth, predicted, {1, 0, 0, 1, 1, 1, 1}).unmixed_recall, 0.5);
  EXPECT_EQ(score(truth, predicted, {1, 1, 1, 1, 1, 1, 0}).unmixed_recall, std::nullopt);
  EXPECT_THROW(score(truth, predicted, {1}), std::invalid_argument);
}

TEST(Score, OfNoLabelsIsZero) {
  const Score nothing = score_of(Counts{{10}, {20}});
  EXPECT_EQ(nothing.micro_recall, 0.0);
  EXPECT_EQ(nothing.mean_iou, 0.0);
  EXPECT_EQ(nothing.null_points, 30);
  EXPECT_EQ(nothing.adjusted_rand_index, 0.0);
  EXPECT_EQ(nothing.instances.missed, 2U);
  EXPECT_EQ(nothing.tubes.at(0).assigned, std::nullopt);
}

TEST(Score, OfOneTubeHasNoRandIndex) {
  EXPECT_EQ(score_of(Counts{{40, 2}}).adjusted_rand_index, std::nullopt);
  EXPECT_NE(score_of(Counts{{40, 2}, {0, 3}}).adjusted_rand_index, std::nullopt);
}

TEST(Score, ALabelStandsForOneTubeOnly) {
  const Score merged = score_of(Counts{{40, 0}, {60, 0}});
  EXPECT_DOUBLE_EQ(merged.micro_recall, 0.6);
  EXPECT_EQ(merged.tubes.at(0).assigned, std::nullopt);
  EXPECT_EQ(merged.tubes.at(0).iou, 0.0);
  EXPECT_EQ(merged.tubes.at(0).null_points, 0);
  EXPECT_DOUBLE_EQ(merged.tubes.at(1).iou, 0.6);
}

TEST(Score, LeavesOutTheBinAndPointsWithoutATrueLabel) {
  const Score with_bin = score({1, 1, 0, 0, -1, 2}, {4, 4, 4, 9, 9, 5});
  EXPECT_EQ(with_bin.points, 3);
  EXPECT_EQ(with_bin.micro_recall, 1.0);
  EXPECT_EQ(with_bin.mean_iou, 1.0);
  EXPECT_EQ(with_bin.confusion.segments.size(), 2U);
}

TEST(Score, ATubePointLabelledAsTheBinIsNull) {
  const Score as_bin = score({1, 1, 1}, {0, 0, 2});
  EXPECT_EQ(as_bin.null_points, 2);
  EXPECT_EQ(as_bin.confusion.segments.size(), 1U);
}

TEST(Score, RefusesWhatHasNoScore) {
  EXPECT_THROW(score({1, 2}, {1}), std::invalid_argument);
  EXPECT_THROW(score({}, {}), std::invalid_argument);
  EXPECT_THROW(score({0, -1}, {1, 1}), std::invalid_argument);
}

RC_GTEST_PROP(Score, OfTheTruthItselfIsPerfect, ()) {
  const Labels labels = *any_labels();
  const Score perfect = score(labels.truth, labels.truth);
  RC_ASSERT(perfect.micro_recall == 1.0);
  RC_ASSERT(perfect.mean_iou == 1.0);
  RC_ASSERT(perfect.detection.precision == 1.0);
  RC_ASSERT(perfect.detection.recall == 1.0);
  RC_ASSERT(perfect.detection.f1 == 1.0);
  RC_ASSERT(perfect.detection.panoptic_quality == 1.0);
  RC_ASSERT(perfect.adjusted_rand_index.value_or(1) == 1.0);
  RC_ASSERT(perfect.instances.correct == perfect.tubes.size());
}

RC_GTEST_PROP(Score, KeepsItsBounds, ()) {
  const Score any = score_of(*any_labels());
  const auto& [precision, recall, f1, panoptic_quality] = any.detection;
  for (const double measure : {any.micro_recall, any.mean_iou, precision, recall, f1, panoptic_quality}) {
    RC_ASSERT(measure >= 0.0);
    RC_ASSERT(measure <= 1.0);
  }
  RC_ASSERT(any.adjusted_rand_index.value_or(0) >= -1.0);
  RC_ASSERT(any.adjusted_rand_index.value_or(0) <= 1.0);
  RC_ASSERT(any.correct_points + any.null_points <= any.points);
  RC_ASSERT(panoptic_quality <= f1);
}

// Other numbers for the labels above 0.
std::vector<std::int32_t> renamed(std::vector<std::int32_t> labels) {
  auto names = *rc::gen::unique<std::vector<std::int32_t>>(8, integer(1, INT32_MAX));
  for (auto& label : labels) {
    if (label > 0) label = names.at(static_cast<std::size_t>(label));
  }
  return labels;
}

RC_GTEST_PROP(Score, DoesNotDependOnTheLabelsNames, ()) {
  const Labels labels = *any_labels();
  const Score one = score_of(labels);
  const Score other = score(renamed(labels.truth), renamed(labels.predicted));
  RC_ASSERT(one.micro_recall == other.micro_recall);
  RC_ASSERT(one.null_points == other.null_points);
  RC_ASSERT(one.adjusted_rand_index == other.adjusted_rand_index);
  RC_ASSERT(one.detection.f1 == other.detection.f1);
  RC_ASSERT(std::abs(one.detection.panoptic_quality - other.detection.panoptic_quality) < 1e-12);
  RC_ASSERT(one.instances.correct == other.instances.correct);
  RC_ASSERT(one.instances.over_segmented == other.instances.over_segmented);
  RC_ASSERT(one.instances.under_segmented == other.instances.under_segmented);
  RC_ASSERT(one.instances.missed == other.instances.missed);
  RC_ASSERT(one.instances.noise == other.instances.noise);
}

RC_GTEST_PROP(Score, DoesNotDependOnTheOrderOfThePoints, ()) {
  const Labels labels = *any_labels();
  Labels backwards = labels;
  std::ranges::reverse(backwards.truth);
  std::ranges::reverse(backwards.predicted);
  const Score one = score_of(labels);
  const Score other = score_of(backwards);
  RC_ASSERT(one.micro_recall == other.micro_recall);
  RC_ASSERT(one.mean_iou == other.mean_iou);
  for (std::size_t i = 0; i < one.tubes.size(); ++i)
    RC_ASSERT(one.tubes[i].assigned == other.tubes[i].assigned);
}

RC_GTEST_PROP(Score, ALabelTakenAwayNeverHelpsMicroRecall, ()) {
  Labels labels = *any_labels();
  const double before = score_of(labels).micro_recall;
  labels.predicted[*integer<std::size_t>(0, labels.predicted.size())] = null_label;
  RC_ASSERT(score_of(labels).micro_recall <= before);
}

}  // namespace
}  // namespace tanglebin
