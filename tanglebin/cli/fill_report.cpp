#include "tanglebin/cli/fill_report.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {
namespace {

nlohmann::ordered_json json_of(const FillReport& report, const FillSummary& summary, double seconds) {
  nlohmann::ordered_json json{{"directory", report.directory}};
  json.update(counts_json(summary.progress));
  json["rejected"] = summary.progress.rejected;
  json["complete"] = summary.is_complete();
  json["seconds"] = seconds;
  json["dataset"] = nullptr;
  if (const auto& dataset = summary.dataset) {
    json["dataset"] = {{"cases", dataset->cases},
                       {"recipe_cases", dataset->recipe_cases},
                       {"failed", dataset->failed},
                       {"digest", dataset->digest}};
  }
  return json;
}

std::string text_of(const std::optional<DatasetSummary>& dataset) {
  if (!dataset) return "other shards are to come or in progress; the last to end completes the manifest";
  const std::string cases =
      dataset->is_complete()
          ? fmt::format("complete, {}", counted(dataset->cases, "case"))
          : fmt::format("{} of the recipe's {}", dataset->cases, counted(dataset->recipe_cases, "case"));
  return fmt::format("{}, digest {}", cases, dataset->digest);
}

void print_text(const FillReport& report, const FillSummary& summary, double seconds) {
  const RunProgress& run = summary.progress;
  print_out("{}: {} {} in {:.1f} s, {} already there, {} rejected", report.directory,
            counted(run.made, "case"), report.verb, seconds, run.found, counted(run.rejected, "attempt"));
  if (run.failed > 0) print_out(", {} failed", run.failed);
  if (summary.was_stopped()) print_out("{}", left_over(run));
  print_out("\n{}: {}\n", report.directory, text_of(summary.dataset));
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
  if (summary.was_stopped()) throw CLI::RuntimeError(exit_interrupted());
  if (!summary.failed.empty()) throw CLI::RuntimeError(exit_cases_failed);
}

}  // namespace tanglebin::cli
