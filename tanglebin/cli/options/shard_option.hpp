#pragma once

#include <optional>
#include <string>

#include "tanglebin/runs/shard.hpp"
#include "tanglebin/runs/workers.hpp"

namespace CLI {
class App;
}

// Options shared by the commands whose runs can be parts of one.
namespace tanglebin::cli {

/// Adds --shard.
void add_shard_option(CLI::App& command, std::optional<std::string>& shard);

/// The shard of --shard, where "auto" is this task's of a job array; nullopt if it is not given. Then says on
/// standard error if this process is one of an array all the same. Throws InputError.
std::optional<Shard> shard_of(const std::optional<std::string>& shard);

/// Adds --case-limit, s.
void add_case_limit_option(CLI::App& command, double& seconds);

/// The limit that this many seconds are.
TimeLimit time_limit_of(double seconds);

}  // namespace tanglebin::cli
