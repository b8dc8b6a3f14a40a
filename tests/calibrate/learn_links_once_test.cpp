#include "tanglebin/calibrate/learn_links_once.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tanglebin/model/axis/settings/link_weights.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::Pair;

// Of the learned weights one is what ships. Links to junctions were not learned: the scenes have no trees.
TEST(LearnedLinks, TakeThePlaceOfThoseOfTheStartEvenIfTheyAreTheDefault) {
  const Parameters start = {{"axis.link.weights.chain_ends.gap", -5},
                            {"axis.link.weights.junction.gap", -7},
                            {"axis.vote.floor_margin", 0.4}};
  const Parameters learned = {{"axis.link.weights.chain_ends.gap", learned_weights.chain_ends[2]},
                              {"axis.link.weights.chain_ends.hidden", -0.25}};
  EXPECT_THAT(with_links(start, learned),
              ElementsAre(Pair("axis.link.weights.chain_ends.hidden", -0.25),
                          Pair("axis.link.weights.junction.gap", -7), Pair("axis.vote.floor_margin", 0.4)));
}

}  // namespace
}  // namespace tanglebin
