#pragma once

#include <functional>

#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/recipe/toml_table.hpp"

// Internal to the room: recipes and TOML trees.
namespace tanglebin {

/// Reads and validates a tree without random numbers.
Recipe read_tree(const toml::table& tree, const TomlSource& source);

/// Reads the one [scanner] of a recipe.
Scanner read_single_scanner(const TomlTable& table);

/// Calls `call`, which validates what was read, and adds file and line to its InputError.
void validate_at(const TomlSource& source, const std::function<void()>& call);

/// The inverse of read_tree(): every value, presets spelled out. Random numbers are tables { min, max } or
/// { one_of }.
toml::table tree_of(const Recipe& recipe);

/// Puts the recipe's random settings into the order in which they are written.
void sort_as_written(Recipe& recipe);

}  // namespace tanglebin
