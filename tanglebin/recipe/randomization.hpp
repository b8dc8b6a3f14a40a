#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/files/toml_table.hpp"
#include "tanglebin/recipe/recipe.hpp"

// Internal to the room: random numbers in TOML trees. Drawing replaces them, so the reader of recipes knows
// nothing of them.
namespace tanglebin {

/// The keys of a random number, in the order in which they are written.
inline constexpr std::array<std::string_view, 6> keys_of_random_numbers{"mean", "sigma",  "min",
                                                                        "max",  "one_of", "per"};

/// A random number of a tree, such as `{ min = 0.1, max = 0.3 }` or `{ one_of = [1, 2, 5] }`, and its place.
struct PlacedNumber {
  std::string path;
  RandomNumber number;
};

/// Finds the random numbers of a tree but numbers of tubes, in the file's order. Throws InputError naming
/// file, line and key of a range that is upside down or incomplete, or of a number drawn for each tube that
/// is not a tube's.
std::vector<PlacedNumber> find_random_numbers(const toml::table& tree, const TomlSource& source);

/// Reads the random number of a path. Throws InputError as find_random_numbers() does.
RandomNumber read_random_number(const toml::table& table, const std::string& path, const TomlSource& source);

/// The inverse of read_random_number().
toml::table random_table(const RandomNumber& number, bool whole);

/// Draws the number of tubes of a set's case.
int draw_number_of_tubes(const Recipe& recipe, const SetRecipe& set, int number);

/// Numbers to replace random ones, by path.
using NumbersByPath = std::map<std::string, double>;

/// A copy of the tree with these of its random numbers replaced.
toml::table with_numbers(const toml::table& tree, const NumbersByPath& numbers);

/// Is the number at this path drawn and written as a whole number?
bool is_whole(std::string_view path);

/// The two ends of a range; all numbers of a list.
std::vector<double> numbers_to_try(const RandomNumber& number);
double lowest(const RandomNumber& number);
double highest(const RandomNumber& number);

/// A number that stands for all that may be drawn: the middle of a range or a list, or the mean.
double middle(const RandomNumber& number, bool whole);

/// The settings of a tree that are random, and those that must be read together with a random one. `recipe`
/// is the tree's, read with any numbers.
std::vector<RandomSetting> random_settings(const toml::table& tree, const Recipe& recipe);

/// Puts settings into a tree, in place of what they replace. Throws InputError for a setting of no table.
void put_settings(toml::table& tree, const std::vector<RandomSetting>& settings);

/// The table and the key of a path: "scanner" and "position" of "scanner.position[2]".
std::string_view table_in(std::string_view path);
std::string_view key_in(std::string_view path);

}  // namespace tanglebin
