#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tanglebin/scan/camera.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/settle/bin.hpp"
#include "tanglebin/settle/settle.hpp"
#include "tanglebin/tube/tube_spec.hpp"

namespace tanglebin {

/// Which files a case gets beside its cloud (PLY) and configuration (text).
struct OutputSettings {
  bool bin_points = true;  ///< the cloud has the bin's points too, label 0
  bool worlds = true;      ///< gazebo_worlds/N.world
  bool pcds = false;       ///< pcds/N.pcd, organized
  bool depths = false;     ///< depths/N.png and N.json
  bool labels = false;     ///< labels/N.png
};

/// A kind of tubes and how many cases of how many of them.
struct SetRecipe {
  std::string name;        ///< letters, digits, '-' and '_': part of a folder's name
  std::vector<int> tubes;  ///< numbers of tubes, each its own folder
  int cases = 20;          ///< of each number of tubes
  TubeSpec spec;
};

/// Everything that a dataset follows from.
struct Recipe {
  std::uint64_t seed = 0;
  int attempts = 100;  ///< tries at a case before it is given up
  Bin bin;
  Camera camera;
  Sensor sensor;
  SettleSettings settle;
  OutputSettings output;
  std::vector<SetRecipe> sets;
};

/// Throws InputError naming the field of which no dataset can be made: what the bin, the scanner, the
/// settling and the tubes refuse, sets that share a name or a folder, numbers out of range (docs/formats.md),
/// a bin smaller than a tube. read_recipe() does it; after a change of the recipe it is the caller's.
void validate(const Recipe& recipe);

/// Reads a recipe (TOML, docs/formats.md). Unknown keys are errors. Throws InputError with file, line and
/// key.
Recipe read_recipe(std::istream& in, const std::string& name);
Recipe read_recipe(const std::filesystem::path& file);

/// A scanner of a recipe's [scanner].
struct Scanner {
  Camera camera;
  Sensor sensor;
};

/// Reads settings such as "scanner.sigma=0.0002" over a preset, as a recipe's [scanner] would have them.
/// Throws InputError naming `option` and the setting.
Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option);

/// Writes a valid recipe resolved: every value there is, presets spelled out. What read_recipe() gave reads
/// back bit for bit; an angle set in code that is no double's degrees is written as the nearest one that is.
void write_recipe(std::ostream& out, const Recipe& recipe);

}  // namespace tanglebin
