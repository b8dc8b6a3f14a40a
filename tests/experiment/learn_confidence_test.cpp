#include "tanglebin/experiment/learn_confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tanglebin/base/random.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

// The points that footprints of three pixels blend are more than a twentieth of a tube's.
Recipe finely_seen_recipe_with_blended_edges() {
  Recipe recipe = test::finely_seen_recipe();
  recipe.camera = downward_camera(960, 600, focal_length_from_hfov(960, 1.22), {0, 0, 2});
  recipe.sensor = sensor_preset("phoxi");
  recipe.sensor.footprint = 3;
  recipe.sensor.working_distance = 2;
  recipe.output.properties.mixed = true;
  return recipe;
}

TEST(LearnConfidence, FindsTheWeightsThatMadeTheExamples) {
  const ConfidenceFeatures truth = {0.5, 2, -1, 0, 0, 0, 0, 0, 0};
  Rng rng(3);
  std::vector<TubeExample> examples;
  for (int i = 0; i < 20'000; ++i) {
    const ConfidenceFeatures features = {1, uniform_real(rng, -1, 1), uniform_real(rng, -1, 1), 0, 0, 0, 0, 0,
                                         0};
    examples.push_back({features, uniform_real(rng, 0, 1) < confidence(features, truth)});
  }
  const ConfidenceFeatures learned = learn_confidence(examples);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(learned[i], truth[i], 0.15) << i;
}

TEST(LearnConfidence, StaysFiniteIfAllTubesAreRight) {
  const std::vector<TubeExample> examples(100, {{1, 1, 0, 0, 0, 0, 0, 0, 0}, true});
  const ConfidenceFeatures learned = learn_confidence(examples);
  for (const double weight : learned) EXPECT_TRUE(std::isfinite(weight));
  EXPECT_GT(confidence(examples[0].features, learned), 0.98);
}

TEST(LearnConfidence, KnowsWhichTubesOfACaseAreWhole) {
  const test::SmallDataset dataset;
  const std::vector<TubeExample> examples = tube_examples(dataset.read(), {{"A", 1, 1}, ""});
  ASSERT_EQ(examples.size(), 1U);
  EXPECT_TRUE(examples[0].is_right);
}

// The residual counts once more.
TEST(LearnConfidence, ModelsACaseAsItIsTold) {
  const test::SmallDataset dataset;
  const Scene nothing{.support = Support{.shape = Support::Shape::nothing}};
  const SeenCase seen{{"A", 1, 1}, ""};
  const TubeExample in_bin = tube_examples(dataset.read(), seen).at(0);
  const TubeExample anywhere = tube_examples(dataset.read(), seen, nothing).at(0);
  constexpr std::size_t residual_once_more = 8;
  EXPECT_EQ(in_bin.features.at(residual_once_more), 0);
  EXPECT_GT(anywhere.features.at(residual_once_more), 0);
}

TEST(LearnConfidence, TakesATubeForWholeIfItLacksOnlyMixedPoints) {
  Recipe recipe = finely_seen_recipe_with_blended_edges();
  const test::SmallDataset marked(recipe);
  recipe.output.properties.mixed = false;
  const test::SmallDataset not_marked(recipe);
  const CaseId lone{"A", 1, 1};
  EXPECT_TRUE(tube_examples(marked.read(), {lone, ""}).at(0).is_right);
  EXPECT_FALSE(tube_examples(not_marked.read(), {lone, ""}).at(0).is_right);
}

}  // namespace
}  // namespace tanglebin
