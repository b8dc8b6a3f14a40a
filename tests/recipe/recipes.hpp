#pragma once

#include <sstream>
#include <string>

#include "tanglebin/recipe/recipe.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {

/// Reads a recipe as the file r.toml.
inline Recipe read(const std::string& text) {
  std::istringstream in(text);
  return read_recipe(in, "r.toml");
}

inline std::string write(const Recipe& recipe) {
  std::ostringstream out;
  write_recipe(out, recipe);
  return out.str();
}

/// What reading says of a bad recipe; "none" of a good one.
inline std::string complaint(const std::string& text) {
  return test::complaint([&] { read(text); });
}

}  // namespace tanglebin
