#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"

namespace CLI {
class App;
}

// Options shared by the commands that work on many cases.
namespace tanglebin::cli {

/// Which cases to work on, and in how many processes.
struct ManyCases {
  int jobs = 1;
  std::vector<std::string> sets;
  std::optional<std::string> tubes;
  std::optional<std::string> cases;
};

/// Adds --jobs, which sets `jobs`; the default is the number of processors.
void add_jobs_option(CLI::App& command, int& jobs);

/// Adds --jobs, --set, --tubes and --cases, which fill `many`.
void add_options(CLI::App& command, ManyCases& many);

/// The cases that match --set, --tubes and --cases. Throws InputError naming `source`, with the cases that
/// there are, if none does.
std::vector<CaseId> chosen(const ManyCases& many, std::vector<CaseId> cases, const std::string& source);

}  // namespace tanglebin::cli
