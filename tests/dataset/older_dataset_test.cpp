#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/merge_datasets.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/recipe_of_0_1_0.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::TemporaryDirectory;
using test::write_bytes;
using testing::HasSubstr;
using testing::IsEmpty;

Recipe recipe_of_source(const std::string& text = test::source_of_0_1_0) {
  std::istringstream in(text);
  return read_recipe(in, "source.toml");
}

/// A dataset whose recipe.toml is as version 0.1.0 wrote it, with one of its two cases.
class OlderDataset : public testing::Test {
protected:
  OlderDataset() {
    write_bytes(directory_ / "recipe.toml", test::recipe_of_0_1_0);
    generate_dataset(recipe_of_source(), {{"A", 2, 1}}, directory_.path(), 1);
  }

  TemporaryDirectory directory_;
};

TEST_F(OlderDataset, IsResumedAndKeepsItsRecipeAsItIs) {
  const FillSummary summary =
      generate_dataset(recipe_of_source(), cases(recipe_of_source()), directory_.path(), 1);
  EXPECT_EQ(summary.progress.found, 1U);
  EXPECT_TRUE(summary.dataset->is_complete());
  EXPECT_EQ(bytes_of(directory_ / "recipe.toml"), test::recipe_of_0_1_0);
  EXPECT_THAT(verify_dataset(directory_.path(), {}).faults, IsEmpty());
}

TEST_F(OlderDataset, IsMergedWithANewerOne) {
  const TemporaryDirectory newer;
  const TemporaryDirectory merged;
  generate_dataset(recipe_of_source(), {{"A", 2, 2}}, newer.path(), 1);
  EXPECT_NE(bytes_of(newer / "recipe.toml"), test::recipe_of_0_1_0);
  EXPECT_TRUE(merge_datasets({directory_.path(), newer.path()}, merged.path(), 1).dataset->is_complete());
  EXPECT_TRUE(merge_datasets({newer.path(), directory_.path()}, merged.path(), 1).dataset->is_complete());
}

TEST_F(OlderDataset, IsReadForExperiments) {
  const Dataset dataset = read_dataset(directory_.path());
  EXPECT_EQ(dataset.recipe, recipe_of_source());
  EXPECT_EQ(dataset.recipe_sha256, sha256(test::recipe_of_0_1_0));
  EXPECT_EQ(dataset.catalogue.record({"A", 2, 1}).drawn, test::drawn_by_0_1_0);
  EXPECT_FALSE(read_case(dataset, {"A", 2, 1}).cloud.points.empty());
}

TEST_F(OlderDataset, IsNotFilledFromAnotherRecipe) {
  std::string text = test::source_of_0_1_0;
  text.replace(text.find("max = 0.25"), 10, "max = 0.26");
  EXPECT_EQ(test::complaint([&] { generate_dataset(recipe_of_source(text), {}, directory_.path(), 1); }),
            (directory_ / "recipe.toml").string() +
                ": the directory belongs to another recipe: bin.height: it has { min = 0.15, max = 0.25 }, "
                "this one { min = 0.15, max = 0.26 }");
}

TEST_F(OlderDataset, OfALaterFormatIsRefused) {
  write_bytes(directory_ / "recipe.toml", "format = 2\n");
  EXPECT_THAT(test::complaint([&] { generate_dataset(recipe_of_source(), {}, directory_.path(), 1); }),
              HasSubstr("recipe.toml:1: this recipe's format is 2; this version of Tanglebin reads up to 1"));
}

}  // namespace
}  // namespace tanglebin
