// Any input is either a recipe, which must read back as the same value after writing, or an InputError; and
// either a setting from the command line or an InputError.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace {

tanglebin::Recipe read(const std::string& text) {
  std::istringstream in(text);
  tanglebin::Recipe recipe = tanglebin::read_recipe(in, "fuzz");
  if (tanglebin::cases(recipe).empty()) std::abort();
  return recipe;
}

std::string write(const tanglebin::Recipe& recipe) {
  std::ostringstream out;
  tanglebin::write_recipe(out, recipe);
  return out.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  is_refused(
      [&] { tanglebin::scanner_with("paper", {"scanner." + text.substr(0, text.find('\n'))}, "fuzz"); });
  tanglebin::Recipe recipe;
  if (is_refused([&] { recipe = read(text); })) return 0;
  // An exception from here on is a bug: the project cannot read what it writes.
  const std::string written = write(recipe);
  const tanglebin::Recipe again = read(written);
  if (again != recipe || difference(again, recipe) || write(again) != written) std::abort();
  return 0;
}
