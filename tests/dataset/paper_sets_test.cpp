// Twenty cases of twenty tubes of the paper's sets A and B, judged from their text files alone by a checker
// that shares no code with the generator.

#include <gtest/gtest.h>

#include <string>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tests/dataset/checker.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::TemporaryDirectory;

void expect_twenty_valid_cases(const std::string& recipe_file, const std::string& set, double bend_max_deg) {
  const TemporaryDirectory directory;
  const Recipe recipe = read_recipe(std::filesystem::path(TANGLEBIN_SOURCE) / "recipes" / recipe_file);
  std::vector<CaseId> twenty;
  for (int number = 1; number <= 20; ++number) twenty.push_back({set, 20, number});
  ASSERT_TRUE(generate_dataset(recipe, twenty, directory.path(), 2).is_complete());

  const checker::CheckerBin bin{.length = 0.55, .width = 0.37};
  const checker::CheckerTube tube{.bend_min_deg = 0, .bend_max_deg = bend_max_deg};
  for (const CaseId& id : twenty) {
    const auto file = directory / (set + "20/tube_configurations/" + std::to_string(id.number) + ".txt");
    for (const std::string& fault : checker::faults_of(file.string(), bin, tube, 20))
      ADD_FAILURE() << file << ": " << fault;
  }
}

TEST(PaperSets, TwentyCasesOfA20AreValid) {
  expect_twenty_valid_cases("set-a.toml", "A", 30);
}

TEST(PaperSets, TwentyCasesOfB20AreValid) {
  expect_twenty_valid_cases("set-b.toml", "B", 45);
}

}  // namespace
}  // namespace tanglebin
