#include "tanglebin/base/error.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

TEST(InputError, NamesFileLineFieldFoundAndExpected) {
  const InputError error({"tubes.txt", 3, "radius"}, "-0.0125", "a positive number");
  EXPECT_STREQ(error.what(), "tubes.txt:3: radius: found -0.0125, expected a positive number");
}

TEST(InputError, TakesAPlainSentence) {
  const InputError error({"tubes.txt", 3, "radius"}, "is missing");
  EXPECT_STREQ(error.what(), "tubes.txt:3: radius: is missing");
}

TEST(InputError, LeavesOutWhatThePlaceDoesNotHave) {
  EXPECT_STREQ(InputError({"cloud.ply", 0, "vertex"}, "is missing").what(), "cloud.ply: vertex: is missing");
  EXPECT_STREQ(InputError({"cloud.ply", 7, ""}, "ends too early").what(), "cloud.ply:7: ends too early");
  EXPECT_STREQ(InputError({"", 0, "tubes"}, "0", "at least 1").what(), "tubes: found 0, expected at least 1");
  EXPECT_STREQ(InputError({"", 0, ""}, "nothing to do").what(), "nothing to do");
}

TEST(InputError, KeepsThePlaceAndTheProblem) {
  try {
    throw InputError({"recipe.toml", 12, "seed"}, "1.5", "an integer");
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().file, "recipe.toml");
    EXPECT_EQ(error.place().line, 12U);
    EXPECT_EQ(error.place().field, "seed");
    EXPECT_EQ(error.problem(), "found 1.5, expected an integer");
  }
}

TEST(SystemError, NamesTheFileAndTheProblem) {
  EXPECT_STREQ(SystemError("out.ply", "cannot write: No space left on device").what(),
               "out.ply: cannot write: No space left on device");
}

}  // namespace
}  // namespace tanglebin
