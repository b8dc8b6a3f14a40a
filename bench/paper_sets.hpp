#pragma once

#include <numbers>
#include <string>

#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// The paper's set A (bends up to 30°) or B (up to 45°), with its bin and scanner.
inline Recipe paper_set(const std::string& name, double bend_max_deg) {
  Recipe recipe;
  recipe.seed = 2022;
  recipe.camera = camera_preset("paper");
  SetRecipe set;
  set.name = name;
  set.kinds[0].segments[0].bend_max = bend_max_deg * std::numbers::pi / 180;
  recipe.sets.push_back(set);
  return recipe;
}

}  // namespace tanglebin
