#include "tanglebin/model/axis/tries.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/labels.hpp"
#include "tests/model/axis/links/bent_bar.hpp"

namespace tanglebin {
namespace {

// Tubes of one kind, all on one tube of this confidence.
AxisModel model_with(double length, double confidence, std::size_t points = 100) {
  AxisModel result;
  result.model.tubes.resize(1);
  result.model.tubes[0].radius = 0.01;
  result.model.evidence = {{.joins = {}, .points = points, .residual = 0.001, .confidence = confidence}};
  result.kinds.emplace_back().kind = {.radius = 0.01, .segments = {{1, 2, length}}, .length_min = length};
  return result;
}

double length_of_likeliest(std::vector<AxisModel> tries) {
  return likeliest_of(tries).kinds[0].kind.length();
}

TEST(Tries, AreInDoubtWhereSomePointsAreProbablyWrongButNotMost) {
  const FragmentSettings settings{.noisy_min = 0.05, .sure_min = 0.95};
  EXPECT_FALSE(is_in_doubt(model_with(0.5, 0.96).model, settings));
  EXPECT_TRUE(is_in_doubt(model_with(0.5, 0.94).model, settings));
  EXPECT_TRUE(is_in_doubt(model_with(0.5, 0.51).model, settings));
  EXPECT_FALSE(is_in_doubt(model_with(0.5, 0.49).model, settings));
  EXPECT_FALSE(is_in_doubt(Model{}, settings));
}

// Where voxels begin decides little where points are exact.
TEST(Tries, AreInDoubtOnlyWherePointsAreNoisy) {
  EXPECT_TRUE(is_in_doubt(model_with(0.5, 0.7).model, {.noisy_min = 0.09}));
  EXPECT_FALSE(is_in_doubt(model_with(0.5, 0.7).model, {.noisy_min = 0.11}));
  AxisModel noise = model_with(0.5, 0.7);
  noise.model.evidence[0].residual = 0.0031;
  EXPECT_FALSE(is_in_doubt(noise.model, {.noisy_min = 0.09})) << "they are nothing but noise";
}

TEST(Tries, OfTheSameLengthAreJudgedByThePointsThatAreProbablyRight) {
  std::vector<AxisModel> tries = {model_with(0.5, 0.9), model_with(0.5, 0.8, 200), model_with(0.5, 0.95)};
  EXPECT_EQ(probably_right(tries[1].model), 160);
  EXPECT_EQ(&likeliest_of(tries), &tries[1]);
}

// A tube of 100 points, and another one of 50 that begins `from` points later.
AxisModel model_with_two(double confidence, double of_other, std::size_t from) {
  AxisModel result = model_with(0.5, confidence);
  result.model.tubes.resize(2, result.model.tubes[0]);
  result.model.evidence.push_back({.joins = {}, .points = 50, .residual = 0.001, .confidence = of_other});
  result.model.labels.assign(200, null_label);
  std::fill_n(result.model.labels.begin(), 100, 1);
  std::fill_n(result.model.labels.begin() + 100 + static_cast<std::ptrdiff_t>(from), 50, 2);
  return result;
}

// What they have in common decides nothing, however sure one of them is of it by chance.
TEST(Tries, AreJudgedByTheTubesInWhichTheyDiffer) {
  std::vector<AxisModel> tries = {model_with_two(0.9, 0.5, 0), model_with_two(0.7, 0.6, 30)};
  EXPECT_GT(probably_right(tries[0].model), probably_right(tries[1].model));
  EXPECT_EQ(&likeliest_of(tries), &tries[1]);
}

// Of tries that have the same tubes, the first is taken.
TEST(Tries, ThatDifferInAFewPointsHaveTheSameTubes) {
  std::vector<AxisModel> tries = {model_with_two(0.75, 0.25, 0), model_with_two(0.75, 0.5, 2)};
  EXPECT_EQ(&likeliest_of(tries), &tries[0]) << "48 of 52 points are on both";
  tries[1] = model_with_two(0.75, 0.5, 3);
  EXPECT_EQ(&likeliest_of(tries), &tries[1]) << "47 of 53 are";
}

TEST(Tries, ThatDoNotHaveATubeMakeItLessSure) {
  KnownScene known;
  known.kinds = {{.radius = 0.01, .length_min = 0.5}};
  std::vector<AxisModel> tries(3, model_with_two(0.9, 0.9, 0));
  tries[1] = model_with_two(0.9, 0.9, 30);
  weigh_by_others(tries[0], tries, known);
  const std::vector<TubeEvidence>& tubes = tries[0].model.evidence;
  EXPECT_EQ(tubes[0].disagreement, 0);
  EXPECT_EQ(tubes[1].disagreement, 0.5);
  EXPECT_LT(tubes[1].confidence, tubes[0].confidence);
}

TEST(Tries, ThatAreTheOnlyOneStayAsSureAsTheyAre) {
  std::vector<AxisModel> tries = {model_with_two(0.9, 0.8, 0)};
  weigh_by_others(tries[0], tries, {});
  for (const TubeEvidence& tube : tries[0].model.evidence) EXPECT_EQ(tube.disagreement, 0);
  EXPECT_EQ(tries[0].model.evidence[1].confidence, 0.8);
}

TEST(Tries, WithALengthThatMostContradictDoNotCountHoweverSureTheyAre) {
  EXPECT_EQ(length_of_likeliest({model_with(0.5, 0.8), model_with(0.7, 0.99), model_with(0.51, 0.7)}), 0.5);
  EXPECT_EQ(length_of_likeliest(
                {model_with(0.7, 0.99), model_with(0.49, 0.7), model_with(0.5, 0.8), model_with(0.6, 0.9)}),
            0.5);
}

TEST(Tries, WithoutAMajorityOfLengthsAreAllJudged) {
  EXPECT_EQ(length_of_likeliest({model_with(0.5, 0.8), model_with(0.7, 0.9)}), 0.7);
  EXPECT_EQ(length_of_likeliest({model_with(0.5, 0.8), model_with(0.7, 0.9), model_with(0.6, 0.7)}), 0.7);
}

AxisModel model_without_a_length(double bound, double confidence) {
  AxisModel result = model_with(bound, confidence);
  result.kinds[0].kind.length_min = 0;
  return result;
}

TEST(Tries, ThatDidNotFindTheLengthDoNotCountWhereMostDid) {
  EXPECT_EQ(
      length_of_likeliest({model_with(0.5, 0.8), model_with(0.5, 0.9), model_without_a_length(0.7, 0.99)}),
      0.5);
  EXPECT_EQ(length_of_likeliest(
                {model_with(0.5, 0.8), model_without_a_length(0.6, 0.7), model_without_a_length(0.7, 0.99)}),
            0.7);
}

AxisModel model_with_shapes(double length, double confidence) {
  AxisModel result = model_with(length, confidence);
  result.kinds[0].shapes = test::equal_bars();
  return result;
}

// Where it is not known what whole tubes look like, false tubes look right.
TEST(Tries, ThatDoNotKnowTheShapeDoNotCountWhereOthersDo) {
  std::vector<AxisModel> tries = {model_with_shapes(0.5, 0.8), model_with(0.5, 0.9),
                                  model_with_shapes(0.5, 0.85)};
  EXPECT_EQ(&likeliest_of(tries), &tries[2]);
}

TEST(Tries, ShareWhatTheyKnowOfTheShapeIfTheyFoundTheSameLength) {
  const std::vector<AxisModel> tries = {model_with(0.5, 0.9), model_with_shapes(0.3, 0.9),
                                        model_with_shapes(0.5, 0.9)};
  EXPECT_FALSE(shapes_in({}, 0, tries[0].kinds[0].kind).are_known());
  EXPECT_FALSE(shapes_in({tries[0], tries[1]}, 0, tries[0].kinds[0].kind).are_known());
  EXPECT_TRUE(shapes_in(tries, 0, tries[0].kinds[0].kind).are_bent());
}

}  // namespace
}  // namespace tanglebin
