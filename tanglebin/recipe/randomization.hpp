#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/recipe/toml_table.hpp"

namespace tanglebin {

// Internal to the room: numbers of a recipe that are drawn anew for each case. They are found in, and put
// into, the recipe's text, so that whatever reads a recipe reads one whose numbers have been drawn.

/// A number that is to be drawn: `{ min = 0.1, max = 0.3 }` or `{ one_of = [1, 2, 5] }`.
struct RandomNumber {
  std::string path;   ///< of its key, and its place in an array: "scanner.position[2]"
  std::size_t line;   ///< where it stands in the text
  std::size_t begin;  ///< offset in the text, and that of what follows
  std::size_t end;
  bool integer;                ///< drawn as a whole number
  std::vector<double> one_of;  ///< empty for a range
  double min = 0;
  double max = 0;
};

/// All numbers to be drawn of a recipe's text (ASCII), in the text's order; `root` is the text parsed. Throws
/// InputError naming file, line and key of a range that is upside down or no range.
std::vector<RandomNumber> find_random_numbers(const toml::table& root, const std::string& text,
                                              const std::string& file);

/// The text with a number in each one's place, line by line as it was.
std::string with_numbers(const std::string& text, const std::vector<RandomNumber>& places,
                         const std::vector<double>& numbers);

/// The number of a case of a recipe with this seed. Numbers with different names are unrelated.
double draw_number(const RandomNumber& number, const std::string& name, std::uint64_t recipe_seed,
                   const CaseId& id);

/// A range's two ends; all that there is in a list.
std::vector<double> numbers_to_try(const RandomNumber& number);
double lowest(const RandomNumber& number);  ///< of them
double highest(const RandomNumber& number);

/// The settings that random numbers are in, and those that go with them: where a part of a scanner's lens or
/// pose is random, all of what the recipe says of the lens or the pose.
std::vector<RandomSetting> random_settings(const toml::table& root);

/// The text of a resolved recipe with these settings in place of its own.
std::string with_settings(const std::string& resolved, const std::vector<RandomSetting>& settings);

}  // namespace tanglebin
