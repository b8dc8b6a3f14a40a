#include "tanglebin/cli/options/shard_option.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"
#include "tanglebin/cli/terminal/print.hpp"

namespace tanglebin::cli {
namespace {

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

Shard shard_of_the_array() {
  if (const std::optional<Shard> shard = shard_from(environment_variable)) return *shard;
  throw InputError({"", 0, "--shard"},
                   "auto, but neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX is set",
                   "a Slurm job array or a Kubernetes indexed job; give I/N elsewhere");
}

// An array may be one over recipes or seeds, so a part is only made if it is asked for.
void mention_array() {
  if (const std::optional<std::string> variable = array_variable(environment_variable)) {
    print_error("tanglebin: taking all cases, though {} is set; --shard auto takes only this task's part\n",
                *variable);
  }
}

}  // namespace

void add_shard_option(CLI::App& command, std::optional<std::string>& shard) {
  command.add_option(
      "--shard", shard,
      "Only part I of N of the cases (I/N); auto: this task's of a Slurm job array or Kubernetes indexed "
      "job");
}

std::optional<Shard> shard_of(const std::optional<std::string>& shard) {
  if (!shard) {
    mention_array();
    return std::nullopt;
  }
  if (*shard == "auto") return shard_of_the_array();
  return parse_shard(*shard, "--shard");
}

void add_case_limit_option(CLI::App& command, double& seconds) {
  command.add_option("--case-limit", seconds, "Seconds after which a case has failed")
      ->capture_default_str()
      ->check(number_within(1e-3, 1e9));
}

TimeLimit time_limit_of(double seconds) {
  return std::chrono::duration_cast<TimeLimit>(std::chrono::duration<double>(seconds));
}

}  // namespace tanglebin::cli
