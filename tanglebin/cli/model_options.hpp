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
  std::vector<std::string> parameters;
};

/// Adds --seed and --parameter, which fill `options`.
void add_options(CLI::App& command, ModelOptions& options);

/// Settings with this seed and these parameters. Throws InputError naming the option.
ModelSettings settings_of(const ModelOptions& options);

}  // namespace tanglebin::cli
