#include "tanglebin/score/score_clouds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tests/score/integer.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::complaint;
using LabelsOfPoints = std::vector<std::int32_t>;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A point for each label, 1 cm apart.
PointCloud cloud_with(const LabelsOfPoints& labels) {
  PointCloud cloud;
  cloud.labels = labels;
  cloud.width = labels.size();
  for (std::size_t i = 0; i < labels.size(); ++i)
    cloud.points.emplace_back(0.01F * static_cast<float>(i), 0.0F, 0.1F);
  return cloud;
}

/// The cloud's points at these places, in this order.
PointCloud chosen(const PointCloud& cloud, const std::vector<std::size_t>& places) {
  PointCloud result;
  result.width = places.size();
  for (const std::size_t i : places) {
    result.points.push_back(cloud.points.at(i));
    if (!cloud.labels.empty()) result.labels.push_back(cloud.labels.at(i));
    if (!cloud.colors.empty()) result.colors.push_back(cloud.colors.at(i));
  }
  return result;
}

PointCloud in_color(PointCloud cloud, const std::vector<Color>& colors) {
  cloud.labels.clear();
  cloud.colors = colors;
  return cloud;
}

Score score_of(const PointCloud& truth, const PointCloud& labelled) {
  return score_clouds(truth, "truth.ply", labelled, "labelled.ply");
}

LabelsOfPoints matched(const PointCloud& truth, const PointCloud& labelled) {
  return match_points(truth, labelled, labelled.labels, "labelled.ply");
}

TEST(ScoreClouds, TheLabelledCloudMayBeASubsetInAnyOrder) {
  const PointCloud truth = cloud_with({1, 1, 1, 2, 2});
  const Score subset = score_of(truth, chosen(cloud_with({7, 7, 7, 8, 8}), {3, 1, 0}));
  EXPECT_EQ(subset.points, 5);
  EXPECT_EQ(subset.correct_points, 3);
  EXPECT_EQ(subset.null_points, 2);
}

TEST(ScoreClouds, AnEmptyLabelledCloudScoresZero) {
  EXPECT_EQ(score_of(cloud_with({1, 2}), PointCloud{}).micro_recall, 0.0);
}

TEST(ScoreClouds, ATruthWithoutTubesIsAnError) {
  EXPECT_EQ(complaint([] { score_of(PointCloud{}, PointCloud{}); }),
            "truth.ply: found no point on a tube, expected at least one to score");
  EXPECT_EQ(complaint([] {
              score_of(cloud_with({0, -1}), cloud_with({1, 1}));
            }),
            "truth.ply: found no point on a tube, expected at least one to score");
}

TEST(ScoreClouds, CloudsWithoutLabelsAndColoursAreErrors) {
  const PointCloud bare = in_color(cloud_with({1, 2}), {});
  EXPECT_EQ(complaint([&] {
              score_of(bare, cloud_with({1, 2}));
            }),
            "truth.ply: found neither labels nor colours, expected a label or a colour for each point");
  EXPECT_EQ(complaint([&] {
              score_of(cloud_with({1, 2}), bare);
            }),
            "labelled.ply: found neither labels nor colours, expected a label or a colour for each point");
}

TEST(ScoreClouds, APicturesColoursStandForNoTubes) {
  const PointCloud cloud = cloud_with(LabelsOfPoints(2001, 1));
  std::vector<Color> colors;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    colors.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 256), 7});
  EXPECT_EQ(complaint([&] { score_of(cloud, in_color(cloud, colors)); }),
            "labelled.ply: found no labels, but 2001 colours, expected a label for each point, or at most "
            "2000 colours, one for each tube");
}

TEST(MatchPoints, NamesTheFirstPointThatTheTruthLacks) {
  PointCloud labelled = cloud_with({1, 1, 1});
  labelled.points[1].y() = 0.25F;
  labelled.points[2].y() = 0.5F;
  EXPECT_EQ(
      complaint([&] {
        matched(cloud_with({1, 1, 1}), labelled);
      }),
      "labelled.ply: point 2: found (0.01, 0.25, 0.1), expected the exact position of a point in the truth");
}

TEST(MatchPoints, MatchesPointsOfOnePlaceInTheirOrder) {
  const PointCloud twice = chosen(cloud_with({1, 2, 3}), {0, 1, 0});
  PointCloud labelled = twice;
  labelled.labels = {4, 5, 6};
  EXPECT_EQ(matched(twice, labelled), (LabelsOfPoints{4, 5, 6}));
  EXPECT_EQ(matched(twice, chosen(labelled, {2})), (LabelsOfPoints{6, null_label, null_label}));
}

TEST(MatchPoints, MorePointsAtOnePlaceThanInTheTruthAreAnError) {
  const PointCloud truth = cloud_with({1, 2});
  EXPECT_EQ(complaint([&] {
              matched(truth, chosen(truth, {0, 1, 0}));
            }),
            "labelled.ply: point 3: found (0, 0, 0.1), expected no more points at this position than "
            "in the truth");
}

TEST(MatchPoints, PassesOverPointsWithoutAPosition) {
  PointCloud truth = cloud_with({1, 1, 2});
  truth.points[1].x() = nan;
  EXPECT_EQ(matched(truth, truth), (LabelsOfPoints{1, null_label, 2}));
  EXPECT_EQ(truth_labels(truth, "truth.ply"), (LabelsOfPoints{1, null_label, 2}));
  EXPECT_EQ(score_of(truth, truth).points, 2);
}

TEST(MatchPoints, ZeroHasNoSign) {
  const PointCloud truth = cloud_with({1});
  PointCloud labelled = truth;
  labelled.points[0].y() = -0.0F;
  EXPECT_EQ(matched(truth, labelled), LabelsOfPoints{1});
}

RC_GTEST_PROP(MatchPoints, FindsEveryPointOfAShuffledSubset, ()) {
  const auto size = *integer<std::size_t>(1, 60);
  PointCloud truth;
  for (std::size_t i = 0; i < size; ++i) {
    // Few coordinates, so that places repeat.
    const auto coordinate = [] { return static_cast<float>(*integer(-2, 3)); };
    truth.points.emplace_back(coordinate(), coordinate(), 0.0F);
  }
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < size; ++i) {
    if (*rc::gen::arbitrary<bool>()) places.push_back(i);
  }
  for (std::size_t i = places.size(); i > 1; --i) {
    std::swap(places[i - 1], places[*integer<std::size_t>(0, i)]);
  }
  PointCloud labelled = chosen(truth, places);
  for (std::size_t i = 0; i < places.size(); ++i) labelled.labels.push_back(static_cast<std::int32_t>(i + 1));

  const LabelsOfPoints labels = matched(truth, labelled);
  RC_ASSERT(std::ranges::count(labels, null_label) == static_cast<std::ptrdiff_t>(size - places.size()));
  for (std::size_t i = 0; i < size; ++i) {
    if (labels[i] == null_label) continue;
    RC_ASSERT(truth.points[i] == labelled.points[static_cast<std::size_t>(labels[i] - 1)]);
  }
}

TEST(MatchPoints, FindsPointsWrittenAsTextOrInDoublePrecision) {
  PointCloud truth = cloud_with({1, 2, 2});
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "property int label\nend_header\n";
  for (const std::size_t i : {2U, 0U, 1U}) {
    std::ostringstream line;
    line.precision(17);
    line << truth.points[i].x() << ' ' << truth.points[i].y() << ' ' << truth.points[i].z() << ' ' << i + 1
         << '\n';
    text += line.str();
  }
  std::istringstream stream(text);
  EXPECT_EQ(matched(truth, read_cloud(stream, "labelled.ply")), (LabelsOfPoints{1, 2, 3}));
}

TEST(LabelsFromColors, InTheTruthGreyIsTheBinAndBlackNull) {
  const Color grey = label_colors(0).front();
  const PointCloud truth =
      in_color(cloud_with({0, 0, 0, 0, 0}), {{9, 0, 0}, grey, null_color, {1, 2, 3}, {9, 0, 0}});
  EXPECT_EQ(truth_labels(truth, "truth.ply"), (LabelsOfPoints{2, bin_label, null_label, 1, 2}));
}

TEST(LabelsFromColors, InALabelledCloudGreyIsALabelAndBlackNull) {
  const Color grey = label_colors(0).front();
  const PointCloud labelled = in_color(cloud_with({0, 0, 0}), {grey, null_color, {1, 2, 3}});
  EXPECT_EQ(predicted_labels(labelled, "labelled.ply"), (LabelsOfPoints{2, null_label, 1}));
}

TEST(LabelsFromColors, LabelsComeBeforeColors) {
  PointCloud both = cloud_with({3, 3, 4});
  both.colors = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(truth_labels(both, "truth.ply"), both.labels);
}

bool repeats(const PointCloud& truth, const PointCloud& labelled) {
  return repeats_truth(truth, labelled, "labelled.ply");
}

TEST(RepeatsTruth, TheTruthsColoursAtEveryPointAreItsOwn) {
  const PointCloud truth = in_color(cloud_with({0, 0, 0}), {{1, 2, 3}, {4, 5, 6}, {4, 5, 7}});
  EXPECT_TRUE(repeats(truth, truth));
  EXPECT_TRUE(repeats(truth, chosen(truth, {2, 0})));
  EXPECT_FALSE(repeats(truth, in_color(truth, {{1, 2, 3}, {4, 5, 6}, {4, 5, 6}})));
  EXPECT_FALSE(repeats(truth, in_color(truth, {{1, 2, 3}, {4, 5, 6}, null_color})));
}

TEST(RepeatsTruth, TheTruthsLabelsOfSeveralTubesAreItsOwn) {
  const PointCloud truth = cloud_with({0, 1, 2, 2});
  EXPECT_TRUE(repeats(truth, truth));
  EXPECT_TRUE(repeats(truth, chosen(truth, {3, 1})));
  EXPECT_FALSE(repeats(truth, cloud_with({0, 1, 2, 1})));
  EXPECT_FALSE(repeats(truth, cloud_with({0, 1, 2, -1})));
  EXPECT_FALSE(repeats(truth, cloud_with({0, 2, 1, 1}))) << "right, with numbers of its own";
}

TEST(RepeatsTruth, RightLabelsOfOneTubeMayBeAResult) {
  EXPECT_FALSE(repeats(cloud_with({0, 1, 1}), cloud_with({0, 1, 1})));
}

TEST(RepeatsTruth, LabelsAndColoursAreNotCompared) {
  const PointCloud truth = cloud_with({1, 2});
  EXPECT_FALSE(repeats(truth, in_color(truth, {{1, 2, 3}, {4, 5, 6}})));
  EXPECT_FALSE(repeats(in_color(truth, {{1, 2, 3}, {4, 5, 6}}), truth));
}

TEST(LabelsFromColors, ScoreAsTheLabelsThemselves) {
  const LabelsOfPoints labels = {0, 1, 1, 2, 3, 3, 3};
  const std::vector<Color> palette = label_colors(3);
  std::vector<Color> colors;
  for (const auto label : labels) colors.push_back(palette[static_cast<std::size_t>(label)]);
  const PointCloud truth = in_color(cloud_with(labels), colors);
  const Score by_color = score_of(truth, cloud_with({5, 5, 5, 6, 6, -1, 6}));
  const Score by_label = score_of(cloud_with(labels), cloud_with({5, 5, 5, 6, 6, -1, 6}));
  EXPECT_EQ(by_color.micro_recall, by_label.micro_recall);
  EXPECT_EQ(by_color.points, 6);
  EXPECT_EQ(score_of(truth, truth).micro_recall, 1.0);
}

}  // namespace
}  // namespace tanglebin
