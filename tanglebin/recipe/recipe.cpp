#include "tanglebin/recipe/recipe.hpp"

#include <algorithm>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {

std::size_t kind_in_turn(const SetRecipe& set, int tube) {
  return static_cast<std::size_t>(tube - 1) % set.kinds.size();
}

const TubeSpec& kind_of(const SetRecipe& set, int tube) {
  return set.each_tube.empty() ? set.kinds[kind_in_turn(set, tube)]
                               : set.each_tube.at(static_cast<std::size_t>(tube - 1));
}

std::vector<int> numbers_of_tubes(const SetRecipe& set) {
  if (!set.drawn_tubes) return set.tubes;
  const RandomNumber& number = *set.drawn_tubes;
  std::vector<int> all(number.one_of.begin(), number.one_of.end());
  if (all.empty()) {
    for (int tubes = static_cast<int>(number.min); tubes <= number.max; ++tubes) all.push_back(tubes);
  }
  return all;
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
