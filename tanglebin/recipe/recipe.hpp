#pragma once

#include <cstddef>
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

/// Which files a case gets besides its configuration (text).
struct OutputSettings {
  bool plys = true;              ///< plys/N.ply, which experiments need
  bool bin_points = true;        ///< the cloud includes the bin's points, label 0
  bool worlds = true;            ///< gazebo_worlds/N.world
  bool pcds = false;             ///< pcds/N.pcd, organized
  bool depths = false;           ///< depths/N.png and N.json
  bool labels = false;           ///< labels/N.png
  bool occlusions = false;       ///< occlusions/N.json: what hides and touches what
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

/// A number that is drawn anew for each case, or for each tube of a case: uniform or normal from `min` to
/// `max`, or from a list.
struct RandomNumber {
  double min = 0;
  double max = 0;
  std::vector<double> one_of{};  ///< if not empty, the number is one of these
  double mean = 0;               ///< of the normal distribution, from min to max
  double sigma = 0;              ///< its standard deviation; 0: the distribution is uniform
  bool per_tube = false;         ///< only of a kind of tubes

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
  std::string path;  ///< of its RandomSetting; "set[0].tube" for a tube's kind, drawn by weight
  double value;      ///< a kind's is 0, 1, …
  int tube = 0;      ///< the tube it is drawn for (1, 2, …); 0 if it holds for all of the scene

  bool operator==(const DrawnNumber&) const = default;
};

/// Which tubes, and how many cases with how many of them.
struct SetRecipe {
  std::string name;        ///< letters, digits, '-' and '_': part of a folder's name
  std::vector<int> tubes;  ///< numbers of tubes, each with its own folder; empty if each case draws its own
  std::optional<RandomNumber> drawn_tubes{};  ///< what each case draws its number of tubes from
  int cases = 20;                             ///< for each number of tubes, or in all if they are drawn
  /// In turn: with two kinds, tubes 1, 3, 5, … of a case are of the first.
  std::vector<TubeSpec> kinds = std::vector<TubeSpec>(1);
  /// If not empty, the kinds are not in turn but drawn for each tube, with probabilities proportional to
  /// these.
  std::vector<double> weights{};
  /// Of a case whose tubes differ: what each tube is drawn from. Then `kinds` have the middles of the numbers
  /// that are drawn for each tube. resolve() sets it; recipes are written without it.
  std::vector<TubeSpec> each_tube{};

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

/// The kind, 0, 1, …, of tube number `tube` (1, 2, …) of a case where kinds take turns.
std::size_t kind_in_turn(const SetRecipe& set, int tube);

/// What tube number `tube` (1, 2, …) of a case is drawn from. `set` is of the case's own recipe (resolve()).
const TubeSpec& kind_of(const SetRecipe& set, int tube);

/// Every number of tubes that a case of a set may have.
std::vector<int> numbers_of_tubes(const SetRecipe& set);

/// The set of this name. Throws InputError if there is none.
const SetRecipe& set_named(const Recipe& recipe, const std::string& name);

/// The first scanner and the further ones.
std::vector<Scanner> scanners(const Recipe& recipe);

/// The numbers of a case, drawn from the recipe's seed, set, number of tubes, case and key: those of the
/// scene, then those of each tube in turn. Numbers of other sets' tubes are left out.
std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id);

/// The recipe of a case: with the numbers drawn for it, and nothing random. Throws InputError if a number is
/// missing, or if the numbers together make no valid recipe.
Recipe resolve(const Recipe& recipe, const CaseId& id, const std::vector<DrawnNumber>& drawn);

/// Throws InputError naming the field that makes the recipe invalid: whatever the bin, the scanner, the
/// settling and the tubes reject, sets that share a name or a folder, numbers out of range (docs/formats.md),
/// a bin smaller than a tube, a number that is drawn but was set in code. read_recipe() calls it; if you
/// change a recipe, call it yourself.
void validate(const Recipe& recipe);

/// Throws InputError naming a scanner that cannot see the bin, or that has it out of range of the depth
/// images that the recipe asks for. A recipe may be valid and of no use: its dataset can still be read.
void expect_bin_in_view(const Recipe& recipe);

/// Reads a recipe (TOML, docs/formats.md). Unknown keys are errors. A random number must make a valid recipe
/// at either end of its range, or with any number of its list. Throws InputError with file, line and key.
Recipe read_recipe(std::istream& in, const std::string& name);
Recipe read_recipe(const std::filesystem::path& file);

/// Reads settings such as "scanner.sigma=0.0002" over a preset, as in a recipe's [scanner], or over another
/// scanner. Throws InputError naming `option` and the setting.
Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option);
Scanner scanner_with(const Scanner& scanner, const std::vector<std::string>& settings,
                     const std::string& option);

/// Writes a valid recipe resolved: every value, presets spelled out. A recipe from read_recipe() reads back
/// as an equal one. An angle set in code is written as the nearest one that has degrees.
void write_recipe(std::ostream& out, const Recipe& recipe);

/// What differs between two valid recipes, as they are written, in the words of an error about `found`:
/// "set[0].tube.bend_max_deg: it has 30.0, this one 45.0". Only the first difference; nullopt if there is
/// none.
std::optional<std::string> difference(const Recipe& found, const Recipe& wanted);

}  // namespace tanglebin
