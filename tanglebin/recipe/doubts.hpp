#pragma once

#include <string>
#include <vector>

#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// What is probably not meant in the valid recipe of a case (resolve()): a camera below the floor or with
/// part of the rim out of view, tubes less than four pixels across on the floor, more tubes than the bin
/// holds, tubes heavier than metal. A clause each, which begins with the place in the recipe; empty if there
/// is nothing.
std::vector<std::string> doubts(const Recipe& recipe);

}  // namespace tanglebin
