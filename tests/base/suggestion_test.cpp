#include "tanglebin/base/suggestion.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

TEST(Suggestion, NamesWhatDiffersInFewCharactersOrIsLonger) {
  EXPECT_EQ(suggestion("generat", {"merge", "generate"}), "did you mean 'generate'?");
  EXPECT_EQ(suggestion("scna", {"score", "scan"}), "did you mean 'scan'?");
  EXPECT_EQ(suggestion("heigth", {"length", "height"}), "did you mean 'height'?");
  EXPECT_EQ(suggestion("scam", {"score", "scan"}), "did you mean 'scan'?");
  EXPECT_EQ(suggestion("exp", {"score", "experiment"}), "did you mean 'experiment'?");
}

TEST(Suggestion, ElseListsWhatThereIs) {
  EXPECT_EQ(suggestion("fly", {"merge", "generate"}), "expected one of merge, generate");
  EXPECT_EQ(suggestion("", {"merge", "generate"}), "expected one of merge, generate");
}

}  // namespace
}  // namespace tanglebin
