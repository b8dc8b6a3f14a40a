#pragma once

#include <string>
#include <vector>

#include "tanglebin/model/model_tubes.hpp"

namespace CLI {
class App;
}

// Options shared by the commands that model.
namespace tanglebin::cli {

/// How to model.
struct ModelOptions {
  std::string seed = "0";
  std::string profile;
  std::vector<std::string> parameters;
};

/// Adds --seed, --profile and --parameter, which fill `options`.
void add_options(CLI::App& command, ModelOptions& options);

/// Settings with this seed, those of the profile, and then these parameters. Throws InputError naming the
/// option, or the place in the profile.
ModelSettings settings_of(const ModelOptions& options);

}  // namespace tanglebin::cli
