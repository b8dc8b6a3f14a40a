#pragma once

#include <string>

#include "tanglebin/cli/progress_report.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin::cli {

/// How a command that fills a dataset tells what came of it.
struct FillReport {
  std::string directory;
  std::string verb;  ///< "made", "merged"
  bool json = false;
  ProgressStyle progress = ProgressStyle::line;
};

/// Prints what came of a run, each failed case on standard error. Throws CLI::RuntimeError where the command
/// is to end with another status than 0: 1 where cases have failed, 130 where it was stopped.
void report_fill(const FillReport& report, const FillSummary& summary, double seconds);

}  // namespace tanglebin::cli
