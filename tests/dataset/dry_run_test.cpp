#include "tanglebin/dataset/dry_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

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
using testing::Not;

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

TEST(DryRun, GivesUpACaseThatTakesTooLong) {
  const Recipe recipe = with_tubes({2});
  const DryRun run = dry_run(recipe, cases(recipe), std::chrono::microseconds(1));
  EXPECT_THAT(run.warnings,
              Contains("A2/1: no valid scene of 2 tubes after 1e-06 s, when a dry run gives up"));
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

TEST(DryRun, WarnsOfEverySet) {
  Recipe recipe = with_tubes({1});
  recipe.sets.push_back(recipe.sets[0]);
  recipe.sets[1].name = "thin";
  recipe.sets[1].kinds[0].radius = 0.003;
  const auto thin = "scanner: a tube of set thin on the floor is only";
  EXPECT_THAT(dry_run(recipe, cases(recipe)).warnings, Contains(HasSubstr(thin)));
  EXPECT_THAT(dry_run(recipe, {{"A", 1, 1}}).warnings, Not(Contains(HasSubstr(thin))));
}

TEST(DryRun, WarnsOfWhatTheNumbersThatASetDrawsMakeWrong) {
  std::istringstream in(
      "[scanner]\nwidth = 640\nheight = 400\nhfov_deg = 70\n"
      "[[set]]\nname = \"wide\"\ntubes = [1]\n[set.tube]\nradius = 0.02\nmass = 0.5\nlength = "
      "0.3\nbend_max_deg = 30\n"
      "[[set]]\nname = \"drawn\"\ntubes = [3]\ncases = 1\n[set.tube]\n"
      "radius = { min = 0.004, max = 0.016, per = \"tube\" }\nmass = 0.5\nlength = 0.3\nbend_max_deg = 30\n");
  const Recipe recipe = read_recipe(in, "r.toml");
  EXPECT_THAT(dry_run(recipe, cases(recipe)).warnings,
              Contains(HasSubstr("scanner: a tube of set drawn on the floor is only")));
}

TEST(DryRun, WarnsOfMoreTubesThanTheBinHoldsWhereTheyAreWanted) {
  Recipe recipe = with_tubes({1, 12});
  recipe.attempts = 1;
  recipe.settle.time_limit = 0.1;
  recipe.bin.width = 0.2;
  recipe.bin.height = 0.06;
  const auto full = "set A: 12 tubes have";
  EXPECT_THAT(dry_run(recipe, cases(recipe)).warnings, Contains(HasSubstr(full)));
  EXPECT_THAT(dry_run(recipe, {{"A", 1, 1}}).warnings, Not(Contains(HasSubstr(full))));
}

}  // namespace
}  // namespace tanglebin
