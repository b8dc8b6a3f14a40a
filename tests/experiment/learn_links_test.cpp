#include "tanglebin/experiment/learn_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "small_dataset.hpp"
#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

// Examples whose log odds are known.
TEST(LearnWeights, FindsTheWeightsThatExamplesWereDrawnBy) {
  const LinkFeatures weights = {1, -2, 0.5, -1, 0.25, 1.5};
  Rng rng(1);
  std::vector<LinkExample> examples;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    LinkFeatures features{1};
    for (std::size_t j = 1; j < features.size(); ++j) features[j] = uniform_real(rng, -2, 2);
    const double odds = std::exp(std::inner_product(weights.begin(), weights.end(), features.begin(), 0.0));
    examples.push_back({LinkKind::chain_ends, features, uniform_real(rng, 0, 1) < odds / (1 + odds)});
  }
  const LinkWeights learned = learn_weights(examples);
  for (std::size_t j = 0; j < weights.size(); ++j) EXPECT_NEAR(learned.chain_ends[j], weights[j], 0.05) << j;
  EXPECT_EQ(learned.tree_ends, LinkFeatures{});
  EXPECT_EQ(learned.junction, LinkFeatures{});
}

TEST(LinkExamples, AreTrueWhereATubeGoesOnAndFalseWhereItDoesNot) {
  const test::SmallDataset small;
  const Dataset dataset = small.read();
  std::vector<LinkExample> examples;
  for (const CaseId& id : cases(dataset)) {
    const std::vector<LinkExample> of_case = link_examples(dataset, id);
    examples.insert(examples.end(), of_case.begin(), of_case.end());
  }
  const auto gap = [](const LinkExample& example) { return example.features[2]; };
  const auto mean_gap = [&](bool is_true) {
    double sum = 0;
    int count = 0;
    for (const LinkExample& example : examples) {
      if (example.is_true != is_true) continue;
      sum += gap(example);
      ++count;
    }
    EXPECT_GT(count, 0) << is_true;
    return sum / count;
  };
  EXPECT_LT(mean_gap(true), 0.5 * mean_gap(false));
}

}  // namespace
}  // namespace tanglebin
