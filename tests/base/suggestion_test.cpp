#include "tanglebin/base/suggestion.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

TEST(Suggestion, NamesWhatDiffersInFewCharactersOrIsLonger) {
  EXPECT_EQ(suggestion("generat", {"merge", "generate"}), "did you mean 'generate'?");
  EXPECT_EQ(suggestion("scna", {"score", "scan"}), "did you mean 'scan'?");
  EXPECT_EQ(suggestion("heigth", {"length", "height"}), "did you mean 'height'?");
  EXPECT_EQ(suggestion("scam", {"score", "scan"}), "did you mean 'scan'?");
  EXPECT_EQ(suggestion("exp", {"score", "experiment"}), "did you mean 'experiment'?");
}

TEST(Suggestion, ElseListsWhatThereIsOrSaysWhatIsExpected) {
  EXPECT_EQ(suggestion("fly", {"merge", "generate"}), "expected one of merge, generate");
  EXPECT_EQ(suggestion("", {"merge", "generate"}), "expected one of merge, generate");
  EXPECT_EQ(suggestion("fly", {"merge", "generate"}, "a command"), "expected a command");
  EXPECT_EQ(suggestion("generat", {"merge", "generate"}, "a command"), "did you mean 'generate'?");
}

TEST(Suggestion, OfALongNameThereIsNone) {
  const std::string name(64, 'x');
  EXPECT_EQ(suggestion(name.substr(1), {name}), "did you mean '" + name.substr(0, 40) + "…'?");
  EXPECT_EQ(suggestion(name + "x", {name}), "expected one of " + name);
}

TEST(Suggestion, RejectsAName) {
  EXPECT_EQ(test::complaint([] {
              reject_name("scam", {"score", "scan"});
            }),
            "found 'scam', did you mean 'scan'?");
  EXPECT_EQ(test::complaint([] {
              reject_name("fly", {"score", "scan"}, "a command");
            }),
            "found 'fly', expected a command");
}

}  // namespace
}  // namespace tanglebin
