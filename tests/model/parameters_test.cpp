#include "tanglebin/model/parameters.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
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
  for (const auto& [name, meaning, standard, is_whole, bounds, range] : declared_parameters()) {
    for (const double other : {bounds.least, bounds.greatest}) {
      if (other == standard) continue;
      ModelSettings settings;
      set_parameter(settings, name + "=" + std::to_string(other), "--parameter");
      EXPECT_THAT(changed_parameters(settings), ElementsAre(Pair(name, other))) << name;
    }
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
  for (const auto& [name, meaning, standard, is_whole, bounds, range] : declared_parameters()) {
    EXPECT_NE(meaning, "") << name;
    EXPECT_EQ(range.has_value(), !name.starts_with("axis.link.weights.")) << name;
    if (!range) continue;
    EXPECT_LE(range->least, standard) << name;
    EXPECT_GE(range->greatest, standard) << name;
    EXPECT_LE(bounds.least, range->least) << name;
    EXPECT_GE(bounds.greatest, range->greatest) << name;
    EXPECT_TRUE(!range->by_factors || range->least > 0) << name;
  }
}

TEST(Parameters, MeanWhatTheManualSays) {
  std::ifstream file(TANGLEBIN_SOURCE "/docs/algorithm.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  for (const auto& [name, meaning, standard, is_whole, bounds, range] : declared_parameters()) {
    if (!range || name.starts_with("paper.")) continue;  // the manual says what those of the paper trade
    EXPECT_THAT(manual, HasSubstr("| " + meaning + " |")) << name;
  }
}

// A row for each feature, a column for each kind of link, with a minus sign.
TEST(Parameters, ThatAreWeightsAreThoseInTheManual) {
  std::ifstream file(TANGLEBIN_SOURCE "/docs/algorithm.md");
  std::string manual{std::istreambuf_iterator<char>(file), {}};
  const std::string minus = "−";
  for (std::size_t at = manual.find(minus); at != std::string::npos; at = manual.find(minus))
    manual.replace(at, minus.size(), "-");
  for (std::size_t i = 0; i < link_features; ++i) {
    std::string columns = "|";
    for (const LinkKind kind : link_kinds) columns += fmt::format(" {:.4f} |", learned_weights.of(kind)[i]);
    const std::string feature = fmt::format("\n| `{}`", feature_name(LinkKind::chain_ends, i));
    const std::size_t row = manual.find(feature);
    ASSERT_NE(row, std::string::npos) << feature;
    EXPECT_THAT(manual.substr(row + 1, manual.find('\n', row + 1) - row - 1), EndsWith(columns)) << feature;
  }
}

TEST(Parameters, SayWhatTheyCannotTake) {
  EXPECT_THAT(complaint("axis.fit.tolerance"),
              HasSubstr("--parameter: found 'axis.fit.tolerance', expected NAME=VALUE"));
  EXPECT_THAT(complaint("axis.magic.number=1"),
              HasSubstr("found 'axis.magic.number', expected a parameter listed in"));
  EXPECT_THAT(complaint("axis.fit.tolerence=1"),
              HasSubstr("--parameter: found 'axis.fit.tolerence', did you mean 'axis.fit.tolerance'?"));
  EXPECT_THAT(complaint("axis.fit.tolerance=much"), HasSubstr("found 'much', expected a number"));
  EXPECT_THAT(complaint("axis.fit.tolerance=-1"),
              HasSubstr("--parameter axis.fit.tolerance: found -1, expected a number from 0.001 to 100"));
  EXPECT_THAT(complaint("axis.fit.tolerance=nan"), HasSubstr("expected a number from 0.001 to 100"));
  EXPECT_THAT(complaint("axis.fit.iterations=2.5"),
              HasSubstr("found 2.5, expected a whole number from 1 to 1000"));
  EXPECT_THAT(complaint("axis.link.weights.junction.gap=-inf"),
              HasSubstr("found -inf, expected a number from -1000000 to 1000000"));
}

// Each of these crashed the method, or kept it busy for ever.
TEST(Parameters, RefuseWhatNoStepCanWorkWith) {
  for (const std::string name :
       {"axis.fragment.voxel", "axis.fragment.step", "axis.vote.patch.reach_min", "axis.vote.patch.reach_max",
        "axis.link.misfit_unit", "paper.join.angle_max"})
    EXPECT_THAT(complaint(name + "=0"), HasSubstr(name + ": found 0, expected a number from 0.0")) << name;
  EXPECT_THAT(complaint("axis.fit.iterations=100000000"),
              HasSubstr("found 100000000, expected a whole number from 1 to 1000"));
  EXPECT_THAT(complaint("axis.link.ends_tolerance=2147483647"),
              HasSubstr("found 2147483647, expected a whole number from 1 to 1000"));
  EXPECT_THAT(complaint("paper.normal_neighbours=1"), HasSubstr("expected a whole number from 3 to 1000"));
}

}  // namespace
}  // namespace tanglebin
