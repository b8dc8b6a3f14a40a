#pragma once

#include <cstdint>
#include <string>

#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin::test {

/// Six cases that are quick to make: set A's tubes, one and three a case, and a coarse camera.
inline Recipe small_recipe() {
  Recipe recipe;
  recipe.seed = 7;
  recipe.attempts = 20;
  recipe.camera = downward_camera(240, 150, focal_length_from_hfov(240, 1.22), {0, 0, 2});
  SetRecipe set;
  set.name = "A";
  set.tubes = {1, 3};
  set.cases = 3;
  set.kinds[0].segments[0].bend_max = 0.5;
  recipe.sets.push_back(set);
  return recipe;
}

/// Case `number` of one tube of set A, as failed.
inline FailedCase failed_case_of(int number, std::uint64_t seed, const std::string& reason) {
  FailedCase failed;
  failed.id.set = "A";
  failed.id.number = number;
  failed.seed = seed;
  failed.reason = reason;
  return failed;
}

}  // namespace tanglebin::test
