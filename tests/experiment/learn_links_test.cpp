#include "tanglebin/experiment/learn_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tanglebin/base/random.hpp"
#include "tests/experiment/small_dataset.hpp"

namespace tanglebin {
namespace {

// Ends with three links each, of which they chose one or none with known odds.
std::vector<EndExample> ends_that_chose_by(const LinkFeatures& weights) {
  Rng rng(1);
  std::vector<EndExample> ends(30000);
  for (EndExample& end : ends) {
    std::vector<double> odds;
    for (int i = 0; i < 3; ++i) {
      LinkFeatures features{1};
      for (std::size_t j = 1; j < features.size(); ++j) features[j] = uniform_real(rng, -2, 2);
      odds.push_back(std::exp(std::inner_product(weights.begin(), weights.end(), features.begin(), 0.0)));
      end.push_back({LinkKind::chain_ends, features, false});
    }
    double left = uniform_real(rng, 0, 1 + std::accumulate(odds.begin(), odds.end(), 0.0));
    for (std::size_t i = 0; i < end.size() && left > 0; ++i) {
      end[i].is_true = left < odds[i];
      left -= odds[i];
    }
  }
  return ends;
}

TEST(LearnWeights, FindsTheWeightsThatEndsChoseBy) {
  const LinkFeatures weights = {1, -2, -0.5, -1, 0.25, 1.5, -0.5, 0.75};
  const LinkWeights learned = learn_weights(ends_that_chose_by(weights));
  for (std::size_t j = 0; j < weights.size(); ++j) EXPECT_NEAR(learned.chain_ends[j], weights[j], 0.05) << j;
  EXPECT_EQ(learned.tree_ends, LinkFeatures{});
  EXPECT_EQ(learned.junction, LinkFeatures{});
}

TEST(LearnWeights, LetNoLinkBeLikelierForALongerGap) {
  const LinkWeights learned = learn_weights(ends_that_chose_by({1, -2, 0.1, -1}));
  EXPECT_EQ(learned.chain_ends[2], 0);
  EXPECT_NEAR(learned.chain_ends[3], -1, 0.1);
}

TEST(EndExamples, AreTrueWhereATubeGoesOnAndFalseWhereItDoesNot) {
  const test::SmallDataset small;
  const Dataset dataset = small.read();
  std::vector<LinkExample> examples;
  for (const CaseId& id : cases(dataset)) {
    for (const EndExample& end : end_examples(dataset, {id, ""}))
      examples.insert(examples.end(), end.begin(), end.end());
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
