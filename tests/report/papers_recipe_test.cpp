#include "tanglebin/report/papers_recipe.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {
namespace {

std::string sha256_of(const Recipe& recipe) {
  std::ostringstream out;
  write_recipe(out, recipe);
  return sha256(out.str());
}

TEST(PapersRecipe, IsThePapersWithAnySeed) {
  const std::filesystem::path recipes = std::filesystem::path(TANGLEBIN_SOURCE) / "recipes";
  for (const char* name : {"paper.toml", "set-a.toml", "set-b.toml"}) {
    Recipe recipe = read_recipe(recipes / name);
    EXPECT_TRUE(is_papers_recipe(sha256_of(recipe), recipe.seed)) << name;
    recipe.seed = 99;
    EXPECT_TRUE(is_papers_recipe(sha256_of(recipe), 99)) << name;
    recipe.bin.length = 0.6;
    EXPECT_FALSE(is_papers_recipe(sha256_of(recipe), 99)) << name;
  }
  const Recipe mixed = read_recipe(recipes / "mixed.toml");
  EXPECT_FALSE(is_papers_recipe(sha256_of(mixed), mixed.seed));
}

}  // namespace
}  // namespace tanglebin
