#include "tanglebin/score/shown_labels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tanglebin {
namespace {

using testing::Pair;
using testing::UnorderedElementsAre;

TEST(ShownLabels, AreThoseOfTheTrueTubesThatTheyAreAssignedTo) {
  const Score counts = score({1, 1, 1, 4, 4, 0}, {9, 9, 5, 5, 5, 0});
  EXPECT_THAT(shown_labels(counts, {1, 4}, {5, 9}),
              UnorderedElementsAre(Pair(-1, -1), Pair(0, 0), Pair(9, 1), Pair(5, 4)));
}

TEST(ShownLabels, OfTubesThatAreNotThereFollowTheTrueOnesInOrder) {
  const Score counts = score({1, 1, 1, 1, 1, 1}, {2, 2, 2, 1, 1, 3});
  EXPECT_THAT(shown_labels(counts, {1, 4}, {3, 2, 1}),
              UnorderedElementsAre(Pair(-1, -1), Pair(0, 0), Pair(2, 1), Pair(3, 5), Pair(1, 6)));
}

}  // namespace
}  // namespace tanglebin
