#include "tanglebin/experiment/learn_confidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tanglebin/base/random.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

TEST(LearnConfidence, FindsTheWeightsThatMadeTheExamples) {
  const ConfidenceFeatures truth = {0.5, 2, -1, 0, 0, 0, 0, 0};
  Rng rng(3);
  std::vector<TubeExample> examples;
  for (int i = 0; i < 20'000; ++i) {
    const ConfidenceFeatures features = {1, uniform_real(rng, -1, 1), uniform_real(rng, -1, 1), 0, 0, 0, 0,
                                         0};
    examples.push_back({features, uniform_real(rng, 0, 1) < confidence(features, truth)});
  }
  const ConfidenceFeatures learned = learn_confidence(examples);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(learned[i], truth[i], 0.15) << i;
}

TEST(LearnConfidence, StaysFiniteIfAllTubesAreRight) {
  const std::vector<TubeExample> examples(100, {{1, 1, 0, 0, 0, 0, 0, 0}, true});
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

}  // namespace
}  // namespace tanglebin
