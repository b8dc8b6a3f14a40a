#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/fill_report.hpp"
#include "tanglebin/cli/many_cases.hpp"
#include "tanglebin/dataset/merge_datasets.hpp"

namespace tanglebin::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string out;
  int jobs = 1;
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
};

void merge(const MergeArguments& arguments) {
  for (const std::string& part : arguments.parts) expect_dataset(part);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::filesystem::path> parts(arguments.parts.begin(), arguments.parts.end());
  const FillSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return merge_datasets(parts, arguments.out, arguments.jobs, progress.observer());
  }();
  report_fill({arguments.out, "merged", arguments.json, arguments.progress}, summary, seconds_since(start));
}

}  // namespace

void add_merge(CLI::App& app) {
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand("merge", "Merge parts of a dataset that were generated separately");
  command->add_option("parts", arguments->parts, "Directories of datasets with the same recipe")->required();
  command
      ->add_option("--out", arguments->out, "Directory of the merged dataset; resumes an interrupted merge")
      ->required();
  add_jobs_option(*command, arguments->jobs);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin merge part1 part2 --out dataset\n"
      "Copies and checks every file. Does not change the parts.");
  command->callback([arguments] { merge(*arguments); });
}

}  // namespace tanglebin::cli
