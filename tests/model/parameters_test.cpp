#include "tanglebin/model/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::string complaint(const std::string& assignment) {
  return test::complaint([&] {
    ModelSettings settings;
    set_parameter(settings, assignment, "--parameter");
  });
}

TEST(Parameters, AreSetByTheNamesOfTheirMembers) {
  ModelSettings settings;
  set_parameter(settings, "axis.fit.tolerance=0.1", "--parameter");
  set_parameter(settings, "axis.vote.patch.neighbours=30", "--parameter");
  set_parameter(settings, "paper.normal_neighbours=20", "--parameter");
  EXPECT_EQ(settings.axis.fit.tolerance, 0.1);
  EXPECT_EQ(settings.axis.vote.patch.neighbours, 30);
  EXPECT_EQ(settings.paper.normal_neighbours, 20);
  EXPECT_THAT(changed_parameters(settings),
              ElementsAre(Pair("axis.fit.tolerance", 0.1), Pair("axis.vote.patch.neighbours", 30),
                          Pair("paper.normal_neighbours", 20)));
}

TEST(Parameters, AreAtTheirDefaultsAtFirstAndEachCanBeSet) {
  EXPECT_THAT(changed_parameters({}), IsEmpty());
  for (const auto& [name, value] : parameters({})) {
    ModelSettings settings;
    const double other = value + 1;
    set_parameter(settings, name + "=" + std::to_string(other), "--parameter");
    EXPECT_THAT(changed_parameters(settings), ElementsAre(Pair(name, testing::DoubleNear(other, 1e-5))))
        << name;
  }
}

TEST(Parameters, AreAllInTheManual) {
  std::ifstream file(TANGLEBIN_SOURCE "/docs/algorithm.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  for (const auto& [name, value] : parameters({})) {
    const bool is_weight = name.starts_with("axis.link.weights.");
    const std::string entry = is_weight ? name.substr(name.rfind('.') + 1) : name;
    EXPECT_THAT(manual, HasSubstr("`" + entry + "`"));
  }
}

TEST(Parameters, HaveARangeAroundTheirDefaultsThatCanBeSearched) {
  for (const auto& [name, meaning, standard, is_whole, range] : declared_parameters()) {
    EXPECT_NE(meaning, "") << name;
    EXPECT_EQ(range.has_value(), !name.starts_with("axis.link.weights.")) << name;
    if (!range) continue;
    EXPECT_LE(range->least, standard) << name;
    EXPECT_GE(range->greatest, standard) << name;
    for (const double value : {range->least, range->greatest}) {
      ModelSettings settings;
      set_parameter(settings, name, value);
      EXPECT_EQ(parameters(settings).at(name), value);
    }
    EXPECT_TRUE(!range->by_factors || range->least > 0) << name;
  }
}

TEST(Parameters, MeanWhatTheManualSays) {
  std::ifstream file(TANGLEBIN_SOURCE "/docs/algorithm.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  for (const auto& [name, meaning, standard, is_whole, range] : declared_parameters()) {
    if (!range || name.starts_with("paper.")) continue;  // the manual says what those of the paper trade
    EXPECT_THAT(manual, HasSubstr("| " + meaning + " |")) << name;
  }
}

TEST(Parameters, SayWhatTheyCannotTake) {
  EXPECT_THAT(complaint("axis.fit.tolerance"),
              HasSubstr("--parameter: found 'axis.fit.tolerance', expected NAME=VALUE"));
  EXPECT_THAT(complaint("axis.fit.magic=1"),
              HasSubstr("found 'axis.fit.magic', expected a parameter listed in"));
  EXPECT_THAT(complaint("axis.fit.tolerance=much"), HasSubstr("found 'much', expected a number"));
  EXPECT_THAT(complaint("axis.fit.tolerance=-1"),
              HasSubstr("--parameter axis.fit.tolerance: found -1, expected a number that is not negative"));
  EXPECT_THAT(complaint("axis.fit.tolerance=nan"), HasSubstr("expected a number that is not negative"));
  EXPECT_THAT(complaint("axis.fit.iterations=2.5"),
              HasSubstr("found 2.5, expected a whole number, 1 or more"));
  EXPECT_THAT(complaint("axis.fit.iterations=1e99"), HasSubstr("expected a whole number, 1 or more"));
}

}  // namespace
}  // namespace tanglebin
