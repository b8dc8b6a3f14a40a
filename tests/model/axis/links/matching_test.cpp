#include "tanglebin/model/axis/links/matching.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(HeaviestMatching, PrefersTwoGoodPairsToOneBetter) {
  // On a path of four the middle is heaviest, the two outer ones together heavier.
  EXPECT_THAT(heaviest_matching(4, {{0, 1, 2}, {1, 2, 3}, {2, 3, 2}}), ElementsAre(0, 2));
  EXPECT_THAT(heaviest_matching(4, {{0, 1, 1}, {1, 2, 3}, {2, 3, 1}}), ElementsAre(1));
}

TEST(HeaviestMatching, LeavesOutWhatDoesNotPay) {
  EXPECT_THAT(heaviest_matching(4, {{0, 1, 0}, {2, 3, -1}}), IsEmpty());
  EXPECT_THAT(heaviest_matching(0, {}), IsEmpty());
}

TEST(HeaviestMatching, KnowsOddCycles) {
  EXPECT_THAT(heaviest_matching(3, {{0, 1, 1}, {1, 2, 1.5}, {2, 0, 1}}), ElementsAre(1));
}

// The heaviest of all sets of pairs that share no vertex.
double best_by_trying(std::size_t vertices, const std::vector<WeightedPair>& pairs) {
  double best = 0;
  for (std::size_t set = 0; set < (std::size_t{1} << pairs.size()); ++set) {
    std::vector<bool> taken(vertices);
    double weight = 0;
    bool valid = true;
    for (std::size_t i = 0; i < pairs.size() && valid; ++i) {
      if ((set >> i & 1U) == 0) continue;
      valid = pairs[i].first != pairs[i].second && !taken[pairs[i].first] && !taken[pairs[i].second];
      taken[pairs[i].first] = taken[pairs[i].second] = true;
      weight += pairs[i].weight;
    }
    if (valid) best = std::max(best, weight);
  }
  return best;
}

RC_GTEST_PROP(HeaviestMatching, IsAsHeavyAsTheBestOfAllSets, ()) {
  constexpr std::size_t vertices = 6;
  std::vector<WeightedPair> pairs;
  const int count = *rc::gen::resize(100, rc::gen::inRange(0, 10));
  for (int i = 0; i < count; ++i) {
    const auto first = *rc::gen::resize(100, rc::gen::inRange<std::size_t>(0, vertices));
    const auto step = *rc::gen::resize(100, rc::gen::inRange<std::size_t>(1, vertices));
    const int weight = *rc::gen::resize(100, rc::gen::inRange(-3, 20));
    pairs.push_back({first, (first + step) % vertices, static_cast<double>(weight)});
  }
  double weight = 0;
  std::vector<int> times_taken(vertices);
  for (const std::size_t i : heaviest_matching(vertices, pairs)) {
    weight += pairs[i].weight;
    ++times_taken[pairs[i].first];
    ++times_taken[pairs[i].second];
  }
  RC_ASSERT(*std::ranges::max_element(times_taken) <= 1);
  RC_ASSERT(weight == best_by_trying(vertices, pairs));
}

}  // namespace
}  // namespace tanglebin
