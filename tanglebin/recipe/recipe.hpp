#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tanglebin/generate/tube_spec.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/settle/settle.hpp"

namespace tanglebin {

/// Which files a case gets beside its cloud (PLY) and configuration (text).
struct OutputSettings {
  bool bin_points = true;        ///< the cloud has the bin's points too, label 0
  bool worlds = true;            ///< gazebo_worlds/N.world
  bool pcds = false;             ///< pcds/N.pcd, organized
  bool depths = false;           ///< depths/N.png and N.json
  bool labels = false;           ///< labels/N.png
  PointProperties properties{};  ///< of the points in plys and pcds
};

/// A scanner and its pose.
struct Scanner {
  std::string name{};  ///< part of a folder's name; empty for the one [scanner] of a recipe
  Camera camera;
  Sensor sensor;
};

/// A setting of a recipe that is drawn anew for each case, or that goes with one, as TOML has it.
struct RandomSetting {
  std::string table;  ///< "scanner", "set[0].tube"
  std::string key;
  std::string value;
};

/// A number drawn for a case.
struct DrawnNumber {
  std::string path;  ///< "scanner.baseline", "scanner.position[2]"
  double value;
};

/// What tubes, and how many cases of how many of them.
struct SetRecipe {
  std::string name;        ///< letters, digits, '-' and '_': part of a folder's name
  std::vector<int> tubes;  ///< numbers of tubes, each its own folder
  int cases = 20;          ///< of each number of tubes
  /// In turn: with two kinds, tubes 1, 3, 5, … of a case are of the first.
  std::vector<TubeSpec> kinds = std::vector<TubeSpec>(1);
};

/// Everything that a dataset follows from.
struct Recipe {
  std::uint64_t seed = 0;
  int attempts = 100;  ///< tries at a case before it is given up
  Bin bin;
  std::string scanner_name;
  Camera camera;  ///< of the first scanner, whose clouds are modelled
  Sensor sensor;
  std::vector<Scanner> further_scanners;  ///< of the same scenes; then all have names
  SettleSettings settle;
  OutputSettings output;
  std::vector<SetRecipe> sets;
  std::vector<RandomSetting> random;  ///< above they have the lowest number that can be drawn
};

/// What the tube of this id (1, 2, …) of a case is drawn from.
const TubeSpec& kind_of(const SetRecipe& set, int tube);

/// The set of this name. Throws InputError where there is none.
const SetRecipe& set_named(const Recipe& recipe, const std::string& name);

/// The first scanner and the further ones.
std::vector<Scanner> scanners(const Recipe& recipe);

/// The numbers of a case, drawn from recipe seed, set, number of tubes, case number and key; those of other
/// sets' tubes are left out.
std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id);

/// The recipe of a case: with the numbers drawn for it, and nothing random. Throws InputError where a number
/// is missing or, together with the others, makes no valid recipe.
Recipe resolve(const Recipe& recipe, const std::vector<DrawnNumber>& drawn);

/// Throws InputError naming the field of which no dataset can be made: what the bin, the scanner, the
/// settling and the tubes refuse, sets that share a name or a folder, numbers out of range (docs/formats.md),
/// a bin smaller than a tube. read_recipe() does it; after a change of the recipe it is the caller's.
void validate(const Recipe& recipe);

/// Reads a recipe (TOML, docs/formats.md). Unknown keys are errors, and so is a number that can be drawn but
/// makes no valid recipe beside the lowest or the highest of the others. Throws InputError with file, line
/// and key.
Recipe read_recipe(std::istream& in, const std::string& name);
Recipe read_recipe(const std::filesystem::path& file);

/// Reads settings such as "scanner.sigma=0.0002" over a preset, as a recipe's [scanner] would have them.
/// Throws InputError naming `option` and the setting.
Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option);

/// Writes a valid recipe resolved: every value there is, presets spelled out. What read_recipe() gave reads
/// back bit for bit; an angle set in code that is no double's degrees is written as the nearest one that is.
void write_recipe(std::ostream& out, const Recipe& recipe);

}  // namespace tanglebin
