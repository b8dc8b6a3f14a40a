#include "tanglebin/cli/options/model_options.hpp"

#include <CLI/CLI.hpp>

#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/model/parameters.hpp"

namespace tanglebin::cli {

void add_options(CLI::App& command, ModelOptions& options) {
  command.add_option("--seed", options.seed, "Seed of the downsampling: decimal, or hexadecimal after 0x")
      ->capture_default_str();
  command
      .add_option("--profile", options.profile,
                  "File with parameters of the methods, as `tanglebin calibrate` and `learn` write it")
      ->option_text("FILE");
  command
      .add_option("--parameter", options.parameters,
                  "Set a parameter of a method, such as axis.fit.tolerance=0.1 (docs/algorithm.md)")
      ->allow_extra_args(false)
      ->option_text("NAME=VALUE");
}

Profile profile_of(const ModelOptions& options, const std::vector<Method>& methods) {
  if (options.profile.empty()) return {};
  Profile profile = read_profile(options.profile);
  expect_for(profile, methods, options.profile);
  return profile;
}

ModelSettings settings_of(const ModelOptions& options, const Profile& profile) {
  ModelSettings settings{.seed = parse_seed(options.seed, "--seed")};
  apply(profile, settings);
  for (const std::string& assignment : options.parameters) set_parameter(settings, assignment, "--parameter");
  return settings;
}

void print_doubts(const Profile& profile, const KnownScene& known, const std::string& file) {
  for (const std::string& doubt : doubts_of(profile, known))
    print_error("tanglebin: warning: {}: {}\n", file, doubt);
}

}  // namespace tanglebin::cli
