#include "tanglebin/report/papers_recipe.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/report/embedded.hpp"

namespace tanglebin {
namespace {

/// As a dataset has it: with every value.
std::string sha256_with_seed(std::string_view toml, std::uint64_t seed) {
  std::istringstream in{std::string(toml)};
  Recipe recipe = read_recipe(in, "the paper's recipe");
  recipe.seed = seed;
  return sha256(bytes_of([&](std::ostream& out) { write_recipe(out, recipe); }));
}

}  // namespace

bool is_papers_recipe(const std::string& recipe_sha256, std::uint64_t seed) {
  const std::array recipes{embedded::paper_toml, embedded::set_a_toml, embedded::set_b_toml};
  return std::ranges::any_of(
      recipes, [&](std::string_view toml) { return sha256_with_seed(toml, seed) == recipe_sha256; });
}

}  // namespace tanglebin
