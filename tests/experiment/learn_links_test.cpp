#include "tanglebin/experiment/learn_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "tanglebin/base/random.hpp"
#include "tanglebin/model/axis/links/choose_links.hpp"
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
  const LinkWeights learned = likeliest_weights(ends_that_chose_by(weights));
  for (std::size_t j = 0; j < weights.size(); ++j) EXPECT_NEAR(learned.chain_ends[j], weights[j], 0.05) << j;
  EXPECT_EQ(learned.tree_ends, LinkFeatures{});
  EXPECT_EQ(learned.junction, LinkFeatures{});
}

TEST(LearnWeights, LetNoLinkBeLikelierForALongerGap) {
  const LinkWeights learned = likeliest_weights(ends_that_chose_by({1, -2, 0.1, -1}));
  EXPECT_EQ(learned.chain_ends[2], 0);
  EXPECT_NEAR(learned.chain_ends[3], -1, 0.1);
}

// The mean share of the links chosen with these weights that are true.
double share_of_true(const std::vector<LinkScene>& scenes, const LinkWeights& weights) {
  LinkSettings settings;
  settings.weights = weights;
  double true_ones = 0;
  double chosen = 0;
  for (const LinkScene& scene : scenes) {
    const std::vector<Link> links = weighed(scene.links, settings);
    for (const std::size_t i : choose_links(scene.fragments, links, scene.kind, settings, scene.seen).links) {
      const auto is_this = [&](const Link& link) { return link.features == links[i].features; };
      const auto found = std::ranges::find_if(scene.links, is_this) - scene.links.begin();
      true_ones += scene.is_true[static_cast<std::size_t>(found)] ? 1 : 0;
      ++chosen;
    }
  }
  EXPECT_GT(chosen, 0);
  return true_ones / chosen;
}

TEST(LearnWeights, ChooseTrueLinks) {
  const test::SmallDataset small;
  const Dataset dataset = small.read();
  std::vector<LinkScene> scenes;
  for (const CaseId& id : cases(dataset))
    std::ranges::move(link_scenes(dataset, {id, ""}), std::back_inserter(scenes));
  const LinkWeights learned = learn_weights(scenes);
  EXPECT_GT(share_of_true(scenes, learned), 0.95);
  EXPECT_LE(learned.chain_ends[2], 0) << "a longer gap makes no link likelier";
  LinkWeights wrong = learned;
  for (double& weight : wrong.chain_ends) weight = -weight;
  EXPECT_LT(share_of_true(scenes, wrong), share_of_true(scenes, learned));
}

TEST(EndExamples, AreTrueWhereATubeGoesOnAndFalseWhereItDoesNot) {
  const test::SmallDataset small;
  const Dataset dataset = small.read();
  std::vector<LinkExample> examples;
  for (const CaseId& id : cases(dataset)) {
    for (const LinkScene& scene : link_scenes(dataset, {id, ""})) {
      for (const EndExample& end : end_examples(scene))
        examples.insert(examples.end(), end.begin(), end.end());
    }
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
