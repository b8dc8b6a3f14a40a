#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/recipe/toml_table.hpp"

// Internal to the room: random numbers in TOML trees. Drawing replaces them, so the reader of recipes knows
// nothing of them.
namespace tanglebin {

/// A random number of a tree, `{ min = 0.1, max = 0.3 }` or `{ one_of = [1, 2, 5] }`, and its place.
struct PlacedNumber {
  std::string path;
  RandomNumber number;
};

/// Finds the random numbers of a tree, in the file's order. Throws InputError naming file, line and key of a
/// range that is upside down or incomplete.
std::vector<PlacedNumber> find_random_numbers(const toml::table& tree, const TomlSource& source);

/// Numbers to replace random ones, by path.
using NumbersByPath = std::map<std::string, double>;

/// A copy of the tree with its random numbers replaced.
toml::table with_numbers(const toml::table& tree, const NumbersByPath& numbers);

/// Is the number at this path drawn and written as a whole number?
bool is_whole(std::string_view path);

/// The two ends of a range; all numbers of a list.
std::vector<double> numbers_to_try(const RandomNumber& number);
double lowest(const RandomNumber& number);
double highest(const RandomNumber& number);

/// The settings of a tree that are random, and those that must be read together with a random one. `recipe`
/// is the tree's, read with any numbers.
std::vector<RandomSetting> random_settings(const toml::table& tree, const Recipe& recipe);

/// Puts settings into a tree, in place of what they replace. Throws InputError for a setting of no table.
void put_settings(toml::table& tree, const std::vector<RandomSetting>& settings);

/// The table and the key of a path: "scanner" and "position" of "scanner.position[2]".
std::string_view table_in(std::string_view path);
std::string_view key_in(std::string_view path);

}  // namespace tanglebin
