#include "tanglebin/profile/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tanglebin/model/parameters.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

ModelSettings read(const std::string& text) {
  std::istringstream in(text);
  ModelSettings settings;
  read_profile(in, "profile.toml", settings);
  return settings;
}

std::string complaint_about(const std::string& text) {
  return test::complaint([&] { read(text); });
}

TEST(Profile, SetsTheParametersThatItNamesAndLeavesTheOthers) {
  const ModelSettings settings = read(
      "format = 1\n"
      "axis.vote.floor_margin = 0.4\n"
      "[axis.link.weights.junction]\n"
      "beyond = -2\n");
  EXPECT_THAT(changed_parameters(settings), ElementsAre(Pair("axis.link.weights.junction.beyond", -2),
                                                        Pair("axis.vote.floor_margin", 0.4)));
}

TEST(Profile, ReadsBackWhatWasWritten) {
  ModelSettings settings;
  double value = -1.0 / 3;
  for (const auto& [name, weight] : link_parameters(LinkWeights{}))
    set_parameter(settings, name, value *= -1.1);
  std::ostringstream out;
  write_profile(out, changed_parameters(settings), "learned");
  EXPECT_THAT(out.str(), HasSubstr("# learned\n"));
  EXPECT_EQ(parameters(read(out.str())), parameters(settings));
}

TEST(Profile, SaysWhichLineIsWrong) {
  EXPECT_THAT(complaint_about("axis.vote.floor_margin = 0.4\n"), HasSubstr("profile.toml"));
  EXPECT_THAT(complaint_about("axis.vote.floor_margin = 0.4\n"), HasSubstr("format: is missing"));
  EXPECT_THAT(complaint_about("format = 2\n"), HasSubstr("profile.toml:1: format: found 2, expected 1"));
  EXPECT_THAT(complaint_about("format = 1\naxis.vote.flor_margin = 0.4\n"),
              HasSubstr("profile.toml:2: found 'axis.vote.flor_margin', expected a parameter listed in"));
  EXPECT_THAT(complaint_about("format = 1\naxis.vote.floor_margin = \"much\"\n"),
              HasSubstr("profile.toml:2: axis.vote.floor_margin: found 'much', expected a number"));
  EXPECT_THAT(complaint_about("format = 1\naxis.vote.floor_margin = [0.4]\n"),
              HasSubstr("expected a number"));
  EXPECT_THAT(
      complaint_about("format = 1\n\naxis.vote.floor_margin = -1\n"),
      HasSubstr("profile.toml:3: axis.vote.floor_margin: found -1, expected a number that is not negative"));
  EXPECT_THAT(complaint_about("format = 1\naxis.link.weights.junction.beyond = inf\n"),
              HasSubstr("axis.link.weights.junction.beyond: found inf, expected a finite number"));
}

TEST(Profile, ThatIsNotThereIsAnError) {
  const auto complaint = test::complaint([] {
    ModelSettings settings;
    read_profile("/nowhere/profile.toml", settings);
  });
  EXPECT_THAT(complaint, HasSubstr("/nowhere/profile.toml: cannot be opened"));
}

}  // namespace
}  // namespace tanglebin
