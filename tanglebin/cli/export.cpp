#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/shard_option.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/terminal/progress_report.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/export/export_dataset.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct ExportArguments {
  std::string dataset;
  std::string format;
  std::string out;
  ManyCases many;
  std::optional<std::string> shard;
  double case_limit = std::chrono::duration<double>(default_case_limit).count();  ///< s
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
};

std::string names_of_formats() {
  std::vector<std::string> names;
  for (const ExportFormat format : export_formats()) names.push_back(name_of(format));
  return fmt::format("{}", fmt::join(names, ", "));
}

void print_json(const ExportArguments& arguments, const ExportSummary& summary, double seconds) {
  nlohmann::ordered_json json;
  if (arguments.progress == ProgressStyle::json) json["event"] = "end";
  json["directory"] = arguments.out;
  json["format"] = arguments.format;
  json.update(counts_json(summary.progress));
  json["complete"] = summary.is_complete;
  json["seconds"] = seconds;
  print_json_line(json);
}

std::string state_of(const ExportSummary& summary) {
  if (summary.is_complete) return "; the export is complete";
  if (summary.was_stopped()) return left_over(summary.progress);
  return summary.failed.empty() ? "; other shards are to come or in progress" : "";
}

void print_text(const ExportArguments& arguments, const ExportSummary& summary, double seconds) {
  const RunProgress& run = summary.progress;
  print_out("{}: {} exported in {:.1f} s, {} already there{}\n", arguments.out, counted(run.made, "case"),
            seconds, run.found, state_of(summary));
}

void export_cases(const ExportArguments& arguments) {
  expect_no_input("--out", arguments.out, {arguments.dataset});
  const ExportFormat format =
      with_option("--format", "format", [&] { return export_format_named(arguments.format); });
  const std::optional<Shard> shard = shard_of(arguments.shard);
  expect_dataset(arguments.dataset);
  const Dataset dataset = read_dataset(arguments.dataset);
  const ExportRequest request{.format = format,
                              .wanted = chosen(arguments.many, cases(dataset), arguments.dataset),
                              .directory = arguments.out,
                              .shard = shard,
                              .jobs = arguments.many.jobs,
                              .case_limit = time_limit_of(arguments.case_limit)};
  const Clock::time_point start = Clock::now();
  const ExportSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return export_dataset(dataset, request, progress.observer());
  }();
  if (arguments.json || arguments.progress == ProgressStyle::json)
    print_json(arguments, summary, seconds_since(start));
  else
    print_text(arguments, summary, seconds_since(start));
  for (const FailedExport& failed : summary.failed)
    print_error("tanglebin: {}: failed: {}\n", name_of(failed.id), failed.reason);
  if (summary.was_stopped()) throw CLI::RuntimeError(exit_interrupted());
  if (!summary.failed.empty()) throw CLI::RuntimeError(exit_cases_failed);
}

}  // namespace

void add_export(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write a dataset in another format: COCO, NumPy, BOP, …");
  command->add_option("dataset", arguments->dataset, "Directory of a dataset from `tanglebin generate`")
      ->required();
  command->add_option("--format", arguments->format, "Format: " + names_of_formats())
      ->required()
      ->option_text("NAME REQUIRED");
  command->add_option("--out", arguments->out, "Directory of the export; resumes an interrupted run")
      ->required();
  add_options(*command, arguments->many);
  add_shard_option(*command, arguments->shard);
  add_case_limit_option(*command, arguments->case_limit);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin export dataset --format coco --out dataset-coco\n"
      "Masks and depths are those of the dataset's scanners, with each tube's whole mask and what hides it.\n"
      "Ctrl-C finishes the cases in progress; run the same command again to resume.\n"
      "Exit status: 3 if cases failed, 130 if interrupted.\n"
      "Formats: docs/export.md.");
  command->callback([arguments] { export_cases(*arguments); });
}

}  // namespace tanglebin::cli
