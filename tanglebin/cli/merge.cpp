#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/fill_report.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/dataset/merge_datasets.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string out;
  int jobs = 1;
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
};

void merge_experiments(const MergeArguments& arguments, const std::vector<std::filesystem::path>& parts) {
  const std::size_t cases = merge_results(parts, arguments.out);
  if (arguments.json) {
    print_json_line({{"directory", arguments.out}, {"cases", cases}});
  } else {
    print_out("{}: {} with results\n", arguments.out, counted(cases, "case"));
  }
}

void merge(const MergeArguments& arguments) {
  expect_no_input("--out", arguments.out, arguments.parts);
  const std::vector<std::filesystem::path> parts(arguments.parts.begin(), arguments.parts.end());
  if (std::filesystem::exists(parts.front() / experiment_name)) return merge_experiments(arguments, parts);
  for (const std::string& part : arguments.parts) expect_dataset(part);
  const auto start = std::chrono::steady_clock::now();
  const FillSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return merge_datasets(parts, arguments.out, arguments.jobs, progress.observer());
  }();
  report_fill({arguments.out, "merged", arguments.json, arguments.progress}, summary, seconds_since(start));
}

}  // namespace

void add_merge(CLI::App& app) {
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge", "Merge parts of a dataset, or of the results of an experiment, that were made separately");
  command
      ->add_option("parts", arguments->parts,
                   "Directories of datasets with the same recipe, or of results of the same experiment")
      ->required();
  command
      ->add_option("--out", arguments->out, "Directory of all parts together; resumes an interrupted merge")
      ->required();
  add_jobs_option(*command, arguments->jobs);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin merge part1 part2 --out dataset\n"
      "  tanglebin merge results1 results2 --out results\n"
      "Copies and checks every file of a dataset. Does not change the parts. The results have no pictures; "
      "`tanglebin experiment` with the same options draws them.");
  command->callback([arguments] { merge(*arguments); });
}

}  // namespace tanglebin::cli
