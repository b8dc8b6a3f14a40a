#pragma once

#include <string>

#include "tanglebin/cli/terminal/progress_report.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin::cli {

/// How a command that fills a dataset reports the result.
struct FillReport {
  std::string directory;
  std::string verb;  ///< "generated", "merged"
  bool json = false;
  ProgressStyle progress = ProgressStyle::line;
};

/// Prints the result of a run, with each failed case on standard error. Throws CLI::RuntimeError to set a
/// nonzero exit status if cases failed or the run was interrupted.
void report_fill(const FillReport& report, const FillSummary& summary, double seconds);

}  // namespace tanglebin::cli
