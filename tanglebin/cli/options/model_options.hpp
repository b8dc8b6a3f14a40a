#pragma once

#include <string>
#include <vector>

#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/profile/profile.hpp"

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

/// The profile of the options; an empty one if there is none. Throws InputError naming the place in it, or if
/// it is for none of these methods.
Profile profile_of(const ModelOptions& options, const std::vector<Method>& methods);

/// Settings with this seed, those of the profile, and then these parameters. Throws InputError naming the
/// option.
ModelSettings settings_of(const ModelOptions& options, const Profile& profile);

/// Warns, a line each on standard error, in which ways a scene is not what a profile was made for.
void print_doubts(const Profile& profile, const KnownScene& known, const std::string& file);

}  // namespace tanglebin::cli
