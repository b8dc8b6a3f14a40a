#include "tanglebin/recipe/recipe.hpp"

#include <algorithm>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {

const TubeSpec& kind_of(const SetRecipe& set, int tube) {
  return set.kinds[static_cast<std::size_t>(tube - 1) % set.kinds.size()];
}

const SetRecipe& set_named(const Recipe& recipe, const std::string& name) {
  const auto found = std::ranges::find(recipe.sets, name, &SetRecipe::name);
  if (found == recipe.sets.end()) throw InputError({"", 0, "set"}, excerpt(name), "a set of the recipe");
  return *found;
}

std::vector<Scanner> scanners(const Recipe& recipe) {
  std::vector<Scanner> all{{recipe.scanner_name, recipe.camera, recipe.sensor}};
  all.insert(all.end(), recipe.further_scanners.begin(), recipe.further_scanners.end());
  return all;
}

}  // namespace tanglebin
