#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tanglebin/files/toml_fields.hpp"
#include "tanglebin/files/toml_table.hpp"
#include "tanglebin/recipe/recipe.hpp"

// Internal to the room: recipes and TOML trees.
namespace tanglebin {

/// Reads and validates a tree without random numbers.
Recipe read_tree(const toml::table& tree, const TomlSource& source);

/// Gives all kinds of tubes of a tree the keys of its [tube] that they do not have, and removes [tube].
/// Throws InputError for a [tube] that is no table, or that has an unknown key.
void inherit_tube(toml::table& tree, TomlSource& source);

/// The keys of a [scanner], but for its preset, and a scanner with those that a table has.
Keys scanner_setting_keys();
Scanner with_settings(Scanner scanner, const TomlTable& table);

/// Reads the one [scanner] of a recipe.
Scanner read_single_scanner(const TomlTable& table);

/// The inverse of read_tree(): every value, presets spelled out. Random numbers are tables { min, max } or
/// { one_of }.
toml::table tree_of(const Recipe& recipe);

/// The path of a set's kind of tubes: "set[0].tube" if there is only one, or "set[0].tube[1]".
std::string path_of_kind(const Recipe& recipe, std::size_t set, std::size_t kind);

/// A setting that two recipes have differently, as they are written.
struct SettingDifference {
  std::string path;
  std::string first;  ///< "nothing" if it lacks the setting
  std::string second;
};

/// The first such setting in the order in which they are written; nullopt if there is none.
std::optional<SettingDifference> first_difference(const Recipe& first, const Recipe& second);

/// Throws InputError naming a member of a recipe that does not hold the lowest number of what is drawn: it
/// was set in code, and drawing would overrule it.
void expect_lowest_numbers(const Recipe& recipe);

/// Puts the recipe's random settings into the order in which they are written.
void sort_as_written(Recipe& recipe);

}  // namespace tanglebin
