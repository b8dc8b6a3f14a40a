#include "tanglebin/dataset/dry_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tanglebin/dataset/generate_dataset.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::files_below;
using test::small_recipe;
using test::TemporaryDirectory;
using testing::Contains;
using testing::HasSubstr;

Recipe with_tubes(const std::vector<int>& tubes) {
  Recipe recipe = small_recipe();
  recipe.sets.resize(1);
  recipe.sets[0].tubes = tubes;
  return recipe;
}

TEST(DryRun, KnowsTheSizeOfADatasetThatItMadeWhole) {
  Recipe recipe = with_tubes({1, 2, 3});
  recipe.sets[0].cases = 1;
  const DryRun run = dry_run(recipe, cases(recipe));
  const TemporaryDirectory directory;
  generate_dataset(recipe, cases(recipe), directory.path(), 1);
  double bytes = 0;
  for (const auto& [path, content] : files_below(directory.path()))
    if (path.starts_with("A")) bytes += static_cast<double>(content.size());
  ASSERT_EQ(run.sets.size(), 1U);
  EXPECT_EQ(run.sets[0].set, "A");
  EXPECT_EQ(run.sets[0].cases, 3U);
  EXPECT_EQ(run.sets[0].bytes, bytes);
  EXPECT_GT(run.sets[0].seconds, 0);
}

TEST(DryRun, InterpolatesBetweenNumbersOfTubes) {
  const auto bytes = [](const Recipe& recipe, const std::vector<CaseId>& ids) {
    return dry_run(recipe, ids).sets.at(0).bytes;
  };
  const Recipe recipe = with_tubes({1, 2, 3, 5});
  const auto of = [&](int tubes) { return bytes(recipe, {{"A", tubes, 1}}); };
  // Of four numbers of tubes it makes the first, the third and the last.
  EXPECT_DOUBLE_EQ(bytes(recipe, {{"A", 1, 1}, {"A", 2, 1}, {"A", 3, 1}, {"A", 5, 1}}),
                   of(1) + (of(1) + of(3)) / 2 + of(3) + of(5));
}

TEST(DryRun, HasTheFirstSceneAsItWillBe) {
  const Recipe recipe = with_tubes({2});
  const DryRun run = dry_run(recipe, cases(recipe));
  ASSERT_TRUE(run.first);
  EXPECT_EQ(run.first->scene.seed, simulate(recipe, {"A", 2, 1}).seed);
  EXPECT_EQ(run.first->scene.tubes.size(), 2U);
}

TEST(DryRun, WarnsOfCasesThatCannotBeMade) {
  Recipe recipe = with_tubes({2});
  recipe.settle.time_limit = 0.1;
  recipe.attempts = 2;
  const DryRun run = dry_run(recipe, cases(recipe));
  EXPECT_THAT(run.warnings, Contains(HasSubstr("A2/1: no valid scene of 2 tubes in 2 attempts")));
  EXPECT_FALSE(run.first);
}

TEST(DryRun, WarnsOfAScannerThatSeesNoTube) {
  Recipe recipe = with_tubes({1});
  recipe.camera.pose.translation().x() = 100;
  EXPECT_THAT(dry_run(recipe, cases(recipe)).warnings, Contains("A1/1: the scanner sees no tube"));
}

TEST(DryRun, WarnsOfWhatLooksWrongInTheRecipe) {
  Recipe recipe = with_tubes({1});
  recipe.camera.pose.translation().x() = 1.1;
  EXPECT_THAT(dry_run(recipe, cases(recipe)).warnings,
              Contains("scanner: part of the bin's rim is out of the camera's view"));
}

}  // namespace
}  // namespace tanglebin
