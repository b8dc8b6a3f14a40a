#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"

// What `generate --dry-run` does.
namespace tanglebin::cli {

struct DryRunReport {
  int jobs = 1;  ///< worker processes that the dataset will be made with
  bool json = false;
  std::optional<std::string> picture;  ///< file to write; "-" for standard output, without anything else
};

/// Prints what the wanted cases, at least one, will take and what looks wrong, and writes the picture if one
/// is wanted.
void print_dry_run(const Recipe& recipe, const std::vector<CaseId>& wanted, const DryRunReport& report);

}  // namespace tanglebin::cli
