#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/dry_run.hpp"
#include "tanglebin/cli/fill_report.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/shard_option.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/terminal/progress_report.hpp"
#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/runs/shard.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct GenerateArguments {
  std::string recipe;
  std::string out;
  ManyCases many;
  std::optional<std::string> shard;
  std::optional<std::string> seed;
  double case_limit = std::chrono::duration<double>(default_case_limit).count();  ///< s
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
  bool dry_run = false;
  std::optional<std::string> picture;
};

Recipe recipe_of(const GenerateArguments& arguments) {
  Recipe recipe = read_input(arguments.recipe, [](auto&&... from) { return read_recipe(from...); });
  if (arguments.seed) {
    recipe.seed = parse_seed(*arguments.seed, "--seed");
    validate(recipe);
  }
  return recipe;
}

void generate(const GenerateArguments& arguments) {
  if (arguments.picture) expect_outputs({{"--picture", *arguments.picture, {".png"}}}, {arguments.recipe});
  const Recipe recipe = recipe_of(arguments);
  const std::optional<Shard> shard = shard_of(arguments.shard);
  std::vector<CaseId> wanted = chosen(arguments.many, cases(recipe), arguments.recipe);
  if (shard) wanted = part_of(*shard, wanted);
  if (recipe.random.empty()) with_file(arguments.recipe, [&] { expect_bin_in_view(recipe); });
  if (arguments.dry_run) {
    if (!arguments.out.empty()) expect_fillable(arguments.out, recipe);
    print_dry_run(
        recipe, wanted,
        {arguments.many.jobs, time_limit_of(arguments.case_limit), arguments.json, arguments.picture});
    return;
  }
  const Clock::time_point start = Clock::now();
  const FillSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return generate_cases({.recipe = recipe,
                           .wanted = wanted,
                           .directory = arguments.out,
                           .shard = shard,
                           .jobs = arguments.many.jobs,
                           .case_limit = time_limit_of(arguments.case_limit)},
                          progress.observer());
  }();
  report_fill({arguments.out, "generated", arguments.json, arguments.progress}, summary,
              seconds_since(start));
}

}  // namespace

void add_generate(CLI::App& app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app.add_subcommand("generate", "Generate a dataset of labelled scans from a recipe");
  command->add_option("recipe", arguments->recipe, "Recipe (TOML); - for standard input")->required();
  CLI::Option* out =
      command->add_option("--out", arguments->out, "Directory of the dataset; resumes an interrupted run");
  CLI::Option* dry_run = command->add_flag(
      "--dry-run", arguments->dry_run,
      "Write no dataset: make a few cases in memory, say what all will take and what looks wrong; with --out "
      "also whether they can go there");
  command
      ->add_option("--picture", arguments->picture,
                   "With --dry-run, a picture (PNG) of what the scanner sees of the first case")
      ->needs(dry_run);
  add_options(*command, arguments->many);
  add_shard_option(*command, arguments->shard);
  add_case_limit_option(*command, arguments->case_limit);
  command->add_option("--seed", arguments->seed,
                      "Seed, instead of the recipe's: decimal, or hexadecimal after 0x");
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin generate recipes/set-a.toml --out dataset --tubes 10 --cases 1-3\n"
      "  tanglebin generate recipe.toml --dry-run --picture first.png\n"
      "Ctrl-C finishes the cases in progress, once more ends at once; run the same command again to resume.\n"
      "Exit status: 3 if cases failed, 130 if interrupted.\n"
      "Formats: docs/formats.md. Clusters: docs/cluster.md.");
  command->callback([arguments, out] {
    if (out->empty() && !arguments->dry_run) throw CLI::RequiredError("--out");
    generate(*arguments);
  });
}

}  // namespace tanglebin::cli
