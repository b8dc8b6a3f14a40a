#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/fill_report.hpp"
#include "tanglebin/cli/many_cases.hpp"
#include "tanglebin/cli/progress_report.hpp"
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
  std::optional<std::int64_t> seed;
  ProgressStyle progress = ProgressStyle::line;
  bool json = false;
};

Recipe recipe_of(const GenerateArguments& arguments) {
  Recipe recipe = read_input(arguments.recipe, [](auto&&... from) { return read_recipe(from...); });
  if (arguments.seed) {
    recipe.seed = static_cast<std::uint64_t>(*arguments.seed);
    validate(recipe);
  }
  return recipe;
}

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::optional<Shard> shard_of(const GenerateArguments& arguments) {
  if (arguments.shard) return parse_shard(*arguments.shard, "--shard");
  return shard_from(environment_variable);
}

void generate(const GenerateArguments& arguments) {
  const Recipe recipe = recipe_of(arguments);
  const std::optional<Shard> shard = shard_of(arguments);
  std::vector<CaseId> wanted = chosen(arguments.many, cases(recipe), arguments.recipe);
  if (shard) wanted = part_of(*shard, wanted);
  const Clock::time_point start = Clock::now();
  const FillSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return generate_dataset(recipe, wanted, arguments.out, arguments.many.jobs, progress.observer(),
                            shard ? name_of(*shard) : "");
  }();
  report_fill({arguments.out, "made", arguments.json, arguments.progress}, summary, seconds_since(start));
}

}  // namespace

void add_generate(CLI::App& app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app.add_subcommand("generate", "Make a dataset of labelled scans from a recipe");
  command->add_option("recipe", arguments->recipe, "Recipe (TOML); - reads standard input")->required();
  command->add_option("--out", arguments->out, "Directory of the dataset; a run that was stopped goes on")
      ->required();
  add_options(*command, arguments->many);
  command->add_option(
      "--shard", arguments->shard,
      "Make the I-th of N parts of the cases (I/N); where it is not given, a Slurm array's or "
      "a Kubernetes indexed job's");
  command->add_option("--seed", arguments->seed, "Seed in place of the recipe's")
      ->check(CLI::NonNegativeNumber);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin generate recipes/set-a.toml --out dataset --tubes 10 --cases 1-3\n"
      "Formats: docs/formats.md; clusters: docs/cluster.md. Ctrl-C finishes the cases under way; the same\n"
      "command goes on. Ends with 1 where cases were given up, 130 where it was stopped.");
  command->callback([arguments] { generate(*arguments); });
}

}  // namespace tanglebin::cli
