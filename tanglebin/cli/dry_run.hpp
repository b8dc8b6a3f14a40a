#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/dry_run.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"

// What `generate --dry-run` does.
namespace tanglebin::cli {

struct DryRunReport {
  int jobs = 1;  ///< worker processes that the dataset will be made with
  std::chrono::steady_clock::duration case_limit = default_patience;  ///< that the dataset's cases will have
  bool json = false;
  std::optional<std::string> picture;  ///< file to write; "-" for standard output, without anything else
};

/// Prints what the wanted cases, at least one, will take and what looks wrong, and writes the picture if one
/// is wanted.
void print_dry_run(const Recipe& recipe, const std::vector<CaseId>& wanted, const DryRunReport& report);

}  // namespace tanglebin::cli
