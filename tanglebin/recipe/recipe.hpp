#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tanglebin/generate/tube_spec.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/settle/settle.hpp"

namespace tanglebin {

/// The latest format of recipes that read_recipe() reads, and the one that write_recipe() writes.
inline constexpr int recipe_format = 1;

/// Which files a case gets besides its cloud (PLY) and configuration (text).
struct OutputSettings {
  bool bin_points = true;        ///< the cloud includes the bin's points, label 0
  bool worlds = true;            ///< gazebo_worlds/N.world
  bool pcds = false;             ///< pcds/N.pcd, organized
  bool depths = false;           ///< depths/N.png and N.json
  bool labels = false;           ///< labels/N.png
  PointProperties properties{};  ///< of the points in plys and pcds

  bool operator==(const OutputSettings&) const = default;
};

/// A scanner and its pose.
struct Scanner {
  std::string name{};  ///< part of a folder's name; empty for the one [scanner] of a recipe
  Camera camera;
  Sensor sensor;

  bool operator==(const Scanner&) const = default;
};

/// A number that is drawn anew for each case: from `min` to `max`, or from a list.
struct RandomNumber {
  double min = 0;
  double max = 0;
  std::vector<double> one_of{};  ///< if not empty, the number is one of these

  bool operator==(const RandomNumber&) const = default;
};

/// A number of a recipe that is random, or that must be read together with a random one: all of a scanner's
/// lens or pose if part of it is random.
struct RandomSetting {
  std::string path;  ///< "scanner.baseline", "scanner.position[2]", "set[0].tube.radius"
  std::variant<double, RandomNumber> value;

  bool operator==(const RandomSetting&) const = default;
};

/// A number drawn for a case.
struct DrawnNumber {
  std::string path;  ///< of its RandomSetting
  double value;

  bool operator==(const DrawnNumber&) const = default;
};

/// Which tubes, and how many cases with how many of them.
struct SetRecipe {
  std::string name;        ///< letters, digits, '-' and '_': part of a folder's name
  std::vector<int> tubes;  ///< numbers of tubes, each with its own folder
  int cases = 20;          ///< for each number of tubes
  /// In turn: with two kinds, tubes 1, 3, 5, … of a case are of the first.
  std::vector<TubeSpec> kinds = std::vector<TubeSpec>(1);

  bool operator==(const SetRecipe&) const = default;
};

/// Everything that defines a dataset.
struct Recipe {
  std::uint64_t seed = 0;
  int attempts = 100;  ///< attempts at a case before it is given up
  Bin bin;
  std::string scanner_name;
  Camera camera;  ///< of the first scanner, whose clouds are modelled
  Sensor sensor;
  std::vector<Scanner> further_scanners;  ///< of the same scenes; then all have names
  SettleSettings settle;
  OutputSettings output;
  std::vector<SetRecipe> sets;
  /// In the order in which they are written. The members above hold the lowest number of each.
  std::vector<RandomSetting> random;

  bool operator==(const Recipe&) const = default;
};

/// The kind of tube number `tube` (1, 2, …) of a case.
const TubeSpec& kind_of(const SetRecipe& set, int tube);

/// The set of this name. Throws InputError if there is none.
const SetRecipe& set_named(const Recipe& recipe, const std::string& name);

/// The first scanner and the further ones.
std::vector<Scanner> scanners(const Recipe& recipe);

/// The numbers of a case, drawn from the recipe's seed, set, number of tubes, case and key. Numbers of other
/// sets' tubes are left out.
std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id);

/// The recipe of a case: with the numbers drawn for it, and nothing random. Throws InputError if a number is
/// missing, or if the numbers together make no valid recipe.
Recipe resolve(const Recipe& recipe, const std::vector<DrawnNumber>& drawn);

/// Throws InputError naming the field that makes the recipe invalid: whatever the bin, the scanner, the
/// settling and the tubes reject, sets that share a name or a folder, numbers out of range (docs/formats.md),
/// a bin smaller than a tube. read_recipe() calls it; if you change a recipe, call it yourself.
void validate(const Recipe& recipe);

/// Reads a recipe (TOML, docs/formats.md). Unknown keys are errors. A random number must make a valid recipe
/// at either end of its range, or with any number of its list. Throws InputError with file, line and key.
Recipe read_recipe(std::istream& in, const std::string& name);
Recipe read_recipe(const std::filesystem::path& file);

/// Reads settings such as "scanner.sigma=0.0002" over a preset, as in a recipe's [scanner]. Throws InputError
/// naming `option` and the setting.
Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option);

/// Writes a valid recipe resolved: every value, presets spelled out. A recipe from read_recipe() reads back
/// as an equal one. An angle set in code is written as the nearest one that has degrees.
void write_recipe(std::ostream& out, const Recipe& recipe);

/// What differs between two valid recipes, as they are written, in the words of an error about `found`:
/// "set[0].tube.bend_max_deg: it has 30.0, this one 45.0". Only the first difference; nullopt if there is
/// none.
std::optional<std::string> difference(const Recipe& found, const Recipe& wanted);

}  // namespace tanglebin
