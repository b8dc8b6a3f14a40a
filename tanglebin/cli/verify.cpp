#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/terminal/progress_report.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/repair_dataset.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  std::string dataset;
  bool rest = false;
  bool repair = false;
  ManyCases many;
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
};

VerifySummary verify(const VerifyArguments& arguments) {
  const std::string recipe = (fs::path(arguments.dataset) / recipe_name).string();
  ProgressReport progress(arguments.progress);
  return verify_dataset(arguments.dataset,
                        {.jobs = arguments.many.jobs,
                         .rest = arguments.rest,
                         .wanted = chosen(arguments.many, cases(recipe_in(arguments.dataset)), recipe)},
                        progress.observer());
}

FillSummary repair(const VerifyArguments& arguments, const VerifySummary& found) {
  ProgressReport progress(arguments.progress);
  return repair_dataset(arguments.dataset, found, arguments.many.jobs, progress.observer());
}

nlohmann::ordered_json json_of(const std::vector<DatasetFault>& faults) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& [where, what] : faults) json.push_back({{"where", where}, {"what", what}});
  return json;
}

nlohmann::ordered_json json_of(const VerifyArguments& arguments, const VerifySummary& summary,
                               std::size_t repaired) {
  nlohmann::ordered_json json;
  if (arguments.progress == ProgressStyle::json) json["event"] = "end";
  json["directory"] = arguments.dataset;
  json["cases"] = summary.cases;
  json["recipe_cases"] = cases(summary.recipe).size();
  json["digest"] = summary.digest;
  json["repaired"] = repaired;
  json["stopped"] = summary.was_stopped;
  json["notes"] = json_of(summary.notes);
  json["faults"] = json_of(summary.faults);
  return json;
}

void print_text(const VerifyArguments& arguments, const VerifySummary& summary, std::size_t repaired) {
  for (const auto& [where, what] : summary.notes) print_out("{}: {}\n", where, what);
  for (const auto& [where, what] : summary.faults) print_out("{}: {}\n", where, what);
  print_out("{}: {} of the recipe's {}, digest {}; ", arguments.dataset, summary.cases,
            counted(cases(summary.recipe).size(), "case"), summary.digest);
  if (repaired > 0) print_out("{} regenerated, ", counted(repaired, "case"));
  print_out("{}\n", summary.was_stopped      ? "stopped"
                    : summary.faults.empty() ? "no faults found"
                                             : counted(summary.faults.size(), "fault") + " found");
}

void verify_and_report(const VerifyArguments& arguments) {
  expect_dataset(arguments.dataset);
  VerifySummary summary = verify(arguments);
  if (arguments.repair && summary.is_in_progress) {
    throw InputError({arguments.dataset, 0, ""},
                     "a run is in progress; repair the dataset when it has ended");
  }
  std::size_t repaired = 0;
  if (arguments.repair && !summary.faults.empty() && !summary.was_stopped) {
    const FillSummary repair_run = repair(arguments, summary);
    repaired = repair_run.progress.made;
    if (repair_run.was_interrupted) {
      summary.was_stopped = true;
    } else {
      summary = verify(arguments);
    }
  }
  if (arguments.json || arguments.progress == ProgressStyle::json) {
    print_json_line(json_of(arguments, summary, repaired));
  } else {
    print_text(arguments, summary, repaired);
  }
  if (summary.was_stopped) throw CLI::RuntimeError(exit_interrupted());
  if (!summary.faults.empty()) throw CLI::RuntimeError(exit_faults);
}

}  // namespace

void add_verify(CLI::App& app) {
  const auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = app.add_subcommand("verify", "Check a dataset for faults, and repair it");
  command->add_option("dataset", arguments->dataset, "Directory of a dataset")->required();
  command->add_flag("--rest", arguments->rest, "Also check that every heap is at rest, by simulation");
  command->add_flag("--repair", arguments->repair, "Regenerate missing and broken cases");
  add_options(*command, arguments->many);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->footer(
      "Example:\n  tanglebin verify dataset --repair\n"
      "Lists the faults and exits with status 4 if there are any; with --repair, if any remain.\n"
      "With --set, --tubes or --cases, checks, misses and repairs only these cases.");
  command->callback([arguments] { verify_and_report(*arguments); });
}

}  // namespace tanglebin::cli
