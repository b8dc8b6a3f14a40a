#include "tanglebin/cli/fill_report.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tanglebin/cli/many_cases.hpp"
#include "tanglebin/cli/print.hpp"

namespace tanglebin::cli {
namespace {

nlohmann::ordered_json json_of(const FillReport& report, const FillSummary& summary, double seconds) {
  const RunProgress& run = summary.progress;
  const DatasetSummary& dataset = summary.dataset;
  nlohmann::ordered_json json{{"directory", report.directory},
                              {"wanted", run.wanted},
                              {"found", run.found},
                              {"made", run.made},
                              {"failed", run.failed},
                              {"rejected", run.rejected},
                              {"complete", summary.is_complete()},
                              {"seconds", seconds}};
  json["dataset"] = {{"cases", dataset.cases},
                     {"recipe_cases", dataset.recipe_cases},
                     {"failed", dataset.failed},
                     {"digest", dataset.digest}};
  return json;
}

void print_text(const FillReport& report, const FillSummary& summary, double seconds) {
  const RunProgress& run = summary.progress;
  const DatasetSummary& dataset = summary.dataset;
  print_out("{}: {} cases {} in {:.1f} s, {} already there, {} attempts rejected", report.directory, run.made,
            report.verb, seconds, run.found, run.rejected);
  if (run.failed > 0) print_out(", {} failed", run.failed);
  if (summary.was_stopped()) {
    print_out("; stopped, {} to go", run.wanted - run.found - run.made - run.failed);
  }
  print_out("\n{}: ", report.directory);
  if (dataset.is_complete()) {
    print_out("complete, {} cases", dataset.cases);
  } else {
    print_out("{} of the recipe's {} cases", dataset.cases, dataset.recipe_cases);
  }
  print_out(", digest {}\n", dataset.digest);
}

}  // namespace

void report_fill(const FillReport& report, const FillSummary& summary, double seconds) {
  if (report.progress == ProgressStyle::json) {
    nlohmann::ordered_json event{{"event", "end"}};
    event.update(json_of(report, summary, seconds));
    print_json_line(event);
  } else if (report.json) {
    print_json_line(json_of(report, summary, seconds));
  } else {
    print_text(report, summary, seconds);
  }
  for (const FailedCase& failed : summary.failed) {
    print_error("tanglebin: {}: failed: {} (seed {:#018x})\n", name_of(failed.id), failed.reason,
                failed.seed);
  }
  if (summary.was_stopped()) throw CLI::RuntimeError(exit_interrupted);
  if (!summary.failed.empty()) throw CLI::RuntimeError(exit_cases_failed);
}

}  // namespace tanglebin::cli
