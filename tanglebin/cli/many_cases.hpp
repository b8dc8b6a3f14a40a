#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"

namespace CLI {
class App;
}

// What the commands that work on many cases have in common.
namespace tanglebin::cli {

/// Which cases, and in how many processes.
struct ManyCases {
  int jobs = 1;
  std::vector<std::string> sets;
  std::vector<int> tubes;
  std::optional<std::string> cases;
};

/// Adds --jobs, which sets `jobs`; as many as there are processors, where it is not given.
void add_jobs_option(CLI::App& command, int& jobs);

/// Adds --jobs, --set, --tubes and --cases, which fill `many`; jobs as many as there are processors.
void add_options(CLI::App& command, ManyCases& many);

/// Those of the cases that --set, --tubes and --cases let through. Throws InputError naming `source` where
/// there is none.
std::vector<CaseId> chosen(const ManyCases& many, std::vector<CaseId> cases, const std::string& source);

/// Exit status of a command that SIGINT or SIGTERM stopped, as a shell reports SIGINT.
inline constexpr int exit_interrupted = 130;

/// Exit status of a command that gave cases up.
inline constexpr int exit_cases_failed = 1;

}  // namespace tanglebin::cli
