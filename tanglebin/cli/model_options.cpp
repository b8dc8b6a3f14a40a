#include "tanglebin/cli/model_options.hpp"

#include <CLI/CLI.hpp>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/profile/profile.hpp"

namespace tanglebin::cli {

void add_options(CLI::App& command, ModelOptions& options) {
  command.add_option("--seed", options.seed, "Seed of the downsampling: decimal, or hexadecimal after 0x")
      ->capture_default_str();
  command
      .add_option("--profile", options.profile,
                  "File with parameters of the methods, as `tanglebin learn` writes it")
      ->option_text("FILE");
  command
      .add_option("--parameter", options.parameters,
                  "Set a parameter of a method, such as axis.fit.tolerance=0.1 (docs/algorithm.md)")
      ->allow_extra_args(false)
      ->option_text("NAME=VALUE");
}

ModelSettings settings_of(const ModelOptions& options) {
  ModelSettings settings{.seed = parse_seed(options.seed, "--seed")};
  if (!options.profile.empty()) read_profile(options.profile, settings);
  for (const std::string& assignment : options.parameters) set_parameter(settings, assignment, "--parameter");
  return settings;
}

}  // namespace tanglebin::cli
