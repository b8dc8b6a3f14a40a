#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

/// The number of a case of a recipe with this seed. Numbers with different names are unrelated.
double draw_number(const RandomNumber& number, bool whole, const std::string& name, std::uint64_t recipe_seed,
                   const CaseId& id) {
  constexpr int no_attempt = 0;  // attempts at a scene count from 1
  const std::uint64_t seed = attempt_seed(recipe_seed, id.set, id.tubes, id.number, no_attempt);
  const CounterRandom random(attempt_seed(seed, name, 0, 0, 0), 0);
  const double uniform = random.uniform(0);
  if (!number.one_of.empty()) {
    return number.one_of[static_cast<std::size_t>(uniform * static_cast<double>(number.one_of.size()))];
  }
  if (whole) return std::min(number.max, std::floor(number.min + uniform * (number.max - number.min + 1)));
  return number.min + uniform * (number.max - number.min);
}

bool is_of_a_set(std::string_view path) {
  return path.starts_with("set[");
}

// Is it drawn for this case?
bool concerns(const std::string& path, const Recipe& recipe, const CaseId& id) {
  if (!is_of_a_set(path)) return true;
  const auto set = std::ranges::find(recipe.sets, id.set, &SetRecipe::name);
  return path.starts_with(fmt::format("set[{}].", set - recipe.sets.begin()));
}

std::size_t index_in(const std::string& path) {
  return std::stoul(path.substr(path.find('[') + 1));
}

// What a number is drawn by: its path, without the place of its set or scanner among the others. (A case's
// seed depends on the set's name.)
std::string name_of(const std::string& path, const Recipe& recipe) {
  const auto after_index = [&] { return path.substr(path.find(']') + 1); };
  if (is_of_a_set(path)) return "set" + after_index();
  if (path.starts_with("scanner["))
    return fmt::format("scanner.{}{}", scanners(recipe).at(index_in(path)).name, after_index());
  return path;
}

}  // namespace

std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id) {
  std::vector<DrawnNumber> drawn;
  for (const auto& [path, value] : recipe.random) {
    const RandomNumber* number = std::get_if<RandomNumber>(&value);
    if (number == nullptr || !concerns(path, recipe, id)) continue;
    drawn.push_back({path, draw_number(*number, is_whole(path), name_of(path, recipe), recipe.seed, id)});
  }
  return drawn;
}

Recipe resolve(const Recipe& recipe, const std::vector<DrawnNumber>& drawn) {
  if (recipe.random.empty()) return recipe;
  NumbersByPath numbers;
  for (const auto& [path, value] : recipe.random) {
    const RandomNumber* number = std::get_if<RandomNumber>(&value);
    if (number == nullptr) continue;
    const auto found = std::ranges::find(drawn, path, &DrawnNumber::path);
    if (found == drawn.end() && !is_of_a_set(path)) throw InputError({"", 0, path}, "has not been drawn");
    numbers[path] = found == drawn.end() ? lowest(*number) : found->value;
  }
  return read_tree(with_numbers(tree_of(recipe), numbers), TomlSource{});
}

}  // namespace tanglebin
