#include "tanglebin/dataset/seen_case.hpp"

#include <algorithm>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {

std::string seen_by(const std::string& scanner, const std::string& what) {
  return scanner.empty() ? what : what + ", " + scanner;
}

std::string name_of(const SeenCase& seen) {
  return seen_by(seen.scanner, name_of(seen.scene));
}

Recipe recipe_seen(const Dataset& dataset, const SeenCase& seen) {
  Recipe recipe = recipe_of(dataset, seen.scene);
  const std::vector<Scanner> all = scanners(recipe);
  const auto found = std::ranges::find(all, seen.scanner, &Scanner::name);
  if (found == all.end())
    throw InputError({"", 0, "scanner"}, excerpt(seen.scanner), "a scanner of the recipe");
  recipe.scanner_name = found->name;
  recipe.camera = found->camera;
  recipe.sensor = found->sensor;
  recipe.further_scanners.clear();
  return recipe;
}

}  // namespace tanglebin
