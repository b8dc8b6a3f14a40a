#pragma once

#include <fmt/core.h>

#include <string>

namespace tanglebin::test {

/// Of a recipe with one set, A, of the paper's tubes, seen by a camera of few pixels.
struct RecipeText {
  int seed;
  int width;          ///< of the image, pixels; its height is five eighths
  std::string tubes;  ///< as TOML has them: "[1, 2]"
  int cases;
};

inline std::string recipe_text(const RecipeText& recipe) {
  return fmt::format(R"(
seed = {}
[scanner]
width = {}
height = {}
[[set]]
name = "A"
tubes = {}
cases = {}
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
bend_max_deg = 30
)",
                     recipe.seed, recipe.width, recipe.width * 5 / 8, recipe.tubes, recipe.cases);
}

}  // namespace tanglebin::test
