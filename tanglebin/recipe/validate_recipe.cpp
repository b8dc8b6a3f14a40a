#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/geometry/view_of_bin.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

constexpr std::size_t longest_name = 64;
constexpr int most_tubes = 1000;                // in a case
constexpr double most_weight = 1e6;             // of a kind of tubes
constexpr std::int64_t most_cases = 1'000'000;  // in a recipe

// A set's path in TOML: set[0].
std::string place(std::size_t set) {
  return fmt::format("set[{}]", set);
}

// Names become parts of folders' names.
void validate_name(const std::string& name, const std::string& field) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  expect(!name.empty() && name.size() <= longest_name && std::ranges::all_of(name, allowed), field,
         excerpt(name), fmt::format("1 to {} letters, digits, '-' and '_'", longest_name));
}

void expect_number_of_tubes(double number, const std::string& field) {
  expect(number >= 1 && number <= most_tubes && number == std::floor(number), field,
         fmt::format("{}", number), fmt::format("a number of tubes from 1 to {}", most_tubes));
}

void validate_numbers_of_tubes(const std::vector<int>& tubes, const std::string& field) {
  expect(!tubes.empty(), field, "none", "at least one number of tubes");
  std::set<int> seen;
  for (const int number : tubes) {
    expect_number_of_tubes(number, field);
    expect(seen.insert(number).second, field, fmt::format("{} twice", number), "different numbers");
  }
}

void validate_tubes(const SetRecipe& set, const std::string& field) {
  if (!set.drawn_tubes) {
    validate_numbers_of_tubes(set.tubes, field);
    return;
  }
  expect(set.tubes.empty(), field, "a list and a random number", "one of them");
  for (const double number : numbers_to_try(*set.drawn_tubes)) expect_number_of_tubes(number, field);
}

// The longest straight piece that can be drawn: one cylinder beside the shortest others.
double longest_straight_piece(const SegmentSpec& segment) {
  if (segment.bend_max == 0) return segment.length;
  return segment.length - (segment.cylinders_min - 1) * segment.cylinder_length_min;
}

// A capsule is in a box if its axis is in the box shrunk by the radius on every side.
double longest_axis_inside(const Bin& bin, double radius) {
  const Eigen::Array3d inner(bin.length, bin.width, bin.height);
  return (inner - 2 * radius).max(0).matrix().norm();
}

// The bin is not smaller than a tube.
void validate_fit(const TubeSpec& spec, const Bin& bin, const std::string& where) {
  const double narrowest = std::min(bin.length, bin.width);
  expect(2 * spec.radius < narrowest, where + ".radius",
         fmt::format("a tube {:.6g} m thick", 2 * spec.radius),
         fmt::format("less than the {:.6g} m between the bin's walls", narrowest));
  const double room = longest_axis_inside(bin, spec.radius);
  const auto expect_room = [&](double longest, const std::string& piece) {
    expect(longest <= room, piece + ".length", fmt::format("a straight piece of up to {:.6g} m", longest),
           fmt::format("at most {:.6g} m, the longest that fits in the bin", room));
  };
  for (std::size_t i = 0; i < spec.segments.size(); ++i) {
    expect_room(longest_straight_piece(spec.segments[i]),
                spec.segments.size() == 1 ? where : fmt::format("{}.segment[{}]", where, i));
  }
  for (std::size_t i = 0; i < spec.pieces.size(); ++i)
    expect_room(spec.pieces[i].length, fmt::format("{}.piece[{}]", where, i));
}

void validate_weights(const SetRecipe& set, const std::string& where) {
  expect(set.weights.empty() || set.weights.size() == set.kinds.size(), where + ".tube",
         fmt::format("{} weights", set.weights.size()), "none, or one for each kind");
  for (std::size_t i = 0; i < set.weights.size(); ++i) {
    const std::string kind = set.kinds.size() == 1 ? where + ".tube" : fmt::format("{}.tube[{}]", where, i);
    const bool valid = set.weights[i] > 0 && set.weights[i] <= most_weight;
    expect(valid, kind + ".weight", fmt::format("{}", set.weights[i]),
           fmt::format("more than 0 and at most {}", most_weight));
  }
}

void validate_set(const SetRecipe& set, const Bin& bin, const std::string& where) {
  validate_name(set.name, where + ".name");
  validate_tubes(set, where + ".tubes");
  expect(set.cases >= 1, where + ".cases", fmt::format("{}", set.cases), "at least 1");
  expect(!set.kinds.empty(), where + ".tube", "none", "at least one kind of tube");
  for (std::size_t i = 0; i < set.kinds.size(); ++i) {
    const std::string kind = set.kinds.size() == 1 ? where + ".tube" : fmt::format("{}.tube[{}]", where, i);
    validate(set.kinds[i], kind);
    validate_fit(set.kinds[i], bin, kind);
  }
  validate_weights(set, where);
}

// "A" with 11 tubes and "A1" with 1 would share the folder A11.
void validate_folders(const std::vector<SetRecipe>& sets) {
  std::set<std::string> names;
  std::map<std::string, std::string> folders;  // the set that each belongs to
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string& name = sets[i].name;
    expect(names.insert(name).second, place(i) + ".name", excerpt(name) + " twice", "unique names");
    for (const int tubes : numbers_of_tubes(sets[i])) {
      const auto [known, is_new] = folders.emplace(folder_name(name, tubes), name);
      expect(is_new || known->second == name, place(i) + ".tubes",
             fmt::format("{}, whose folder {} also belongs to set {}", tubes, known->first,
                         excerpt(known->second)),
             "different folders");
    }
  }
}

void validate_number_of_cases(const std::vector<SetRecipe>& sets) {
  std::int64_t total = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::size_t counts = sets[i].drawn_tubes ? 1 : sets[i].tubes.size();
    total += static_cast<std::int64_t>(counts) * sets[i].cases;
    expect(total <= most_cases, place(i) + ".cases", fmt::format("{} cases in total", total),
           fmt::format("at most {}", most_cases));
  }
}

// A scanner's folder is beside the folders of the other kinds of files.
constexpr std::array<std::string_view, 7> folders_of_kinds{
    "plys", "pcds", "depths", "labels", "occlusions", "tube_configurations", "gazebo_worlds"};

std::string place_of_scanner(const Recipe& recipe, std::size_t index) {
  return recipe.scanner_name.empty() ? "scanner" : fmt::format("scanner[{}]", index);
}

// Adds to an error's field which scanner it is about.
template <typename Check>
void check_scanner(const std::string& where, const Check& check) {
  try {
    check();
  } catch (const InputError& error) {
    const std::string& field = error.place().field;
    throw InputError({"", 0, where + field.substr(field.find('.'))}, error.problem());
  }
}

void validate_scanners(const Recipe& recipe) {
  const std::vector<Scanner> all = scanners(recipe);
  std::set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Scanner& scanner = all[i];
    const std::string where = place_of_scanner(recipe, i);
    check_scanner(where, [&] {
      validate(scanner.camera);
      validate(scanner.sensor);
    });
    if (all.size() == 1 && scanner.name.empty()) return;
    validate_name(scanner.name, where + ".name");
    expect(std::ranges::find(folders_of_kinds, scanner.name) == folders_of_kinds.end(), where + ".name",
           excerpt(scanner.name), "a name that no other folder has");
    expect(names.insert(scanner.name).second, where + ".name", excerpt(scanner.name) + " twice",
           "unique names");
  }
}

// Depth images of a bin beyond their range are empty.
void expect_in_range_of_depths(const Camera& camera, const Bin& bin) {
  const double nearest = depths_of(camera, bin).nearest;
  expect(nearest <= deepest, "scanner.position", fmt::format("the bin {:.4g} m from the camera", nearest),
         fmt::format("at most {} m, the largest depth in a depth image; or switch depths off", deepest));
}

}  // namespace

void expect_bin_in_view(const Recipe& recipe) {
  const std::vector<Scanner> all = scanners(recipe);
  for (std::size_t i = 0; i < all.size(); ++i) {
    check_scanner(place_of_scanner(recipe, i), [&] {
      validate(all[i].camera, recipe.bin);
      if (recipe.output.depths) expect_in_range_of_depths(all[i].camera, recipe.bin);
    });
  }
}

void validate(const Recipe& recipe) {
  expect(std::in_range<std::int64_t>(recipe.seed), "seed", fmt::format("{}", recipe.seed),
         fmt::format("at most {}", std::numeric_limits<std::int64_t>::max()));
  expect(recipe.attempts >= 1, "attempts", fmt::format("{}", recipe.attempts), "at least 1");
  validate(recipe.bin);
  validate_scanners(recipe);
  validate(recipe.settle);
  expect(!recipe.sets.empty(), "set", "none", "at least one [[set]]");
  for (std::size_t i = 0; i < recipe.sets.size(); ++i) validate_set(recipe.sets[i], recipe.bin, place(i));
  validate_folders(recipe.sets);
  validate_number_of_cases(recipe.sets);
  if (!recipe.random.empty()) expect_lowest_numbers(recipe);
}

}  // namespace tanglebin
