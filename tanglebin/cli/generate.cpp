#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/many_cases.hpp"
#include "tanglebin/cli/progress_line.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/recipe.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct GenerateArguments {
  std::string recipe;
  std::string out;
  ManyCases many;
  std::optional<std::string> shard;
  std::optional<std::int64_t> seed;
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

// The recipe's cases that --set, --tubes and --cases let through, and of these the shard's.
std::vector<CaseId> chosen_cases(const GenerateArguments& arguments, const Recipe& recipe) {
  std::vector<CaseId> all = chosen(arguments.many, cases(recipe), arguments.recipe);
  if (!arguments.shard) return all;
  const Shard shard = parse_shard(*arguments.shard, "--shard");
  std::vector<CaseId> part;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < all.size();
       i += static_cast<std::size_t>(shard.count)) {
    part.push_back(all[i]);
  }
  return part;
}

void print_summary(const GenerateArguments& arguments, const GenerateSummary& summary, double seconds) {
  if (arguments.json) {
    const nlohmann::ordered_json json{
        {"directory", arguments.out}, {"wanted", summary.wanted},     {"found", summary.found},
        {"made", summary.made},       {"rejected", summary.rejected}, {"complete", summary.complete()},
        {"seconds", seconds}};
    fmt::print("{}\n", json.dump());
    return;
  }
  fmt::print("{}: {} cases made in {:.1f} s ({} attempts rejected), {} were there{}\n", arguments.out,
             summary.made, seconds, summary.rejected, summary.found,
             summary.complete()
                 ? ""
                 : fmt::format("; stopped, {} to go", summary.wanted - summary.found - summary.made));
}

void generate(const GenerateArguments& arguments) {
  const Recipe recipe = recipe_of(arguments);
  const std::vector<CaseId> wanted = chosen_cases(arguments, recipe);
  const Clock::time_point start = Clock::now();
  const GenerateSummary summary = [&] {
    ProgressLine line(wanted.size());
    return generate_dataset(recipe, wanted, arguments.out, arguments.many.jobs,
                            [&](std::size_t done) { line.show(done); });
  }();
  print_summary(arguments, summary, seconds_since(start));
  if (!summary.complete()) throw CLI::RuntimeError(exit_interrupted);
}

}  // namespace

void add_generate(CLI::App& app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app.add_subcommand("generate", "Make a dataset of labelled scans from a recipe");
  command->add_option("recipe", arguments->recipe, "Recipe (TOML); - reads standard input")->required();
  command->add_option("--out", arguments->out, "Directory of the dataset; a run that was stopped goes on")
      ->required();
  add_options(*command, arguments->many);
  command->add_option("--shard", arguments->shard,
                      "Make the I-th of N parts of the cases (I/N), in a directory of its own");
  command->add_option("--seed", arguments->seed, "Seed in place of the recipe's")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin generate recipes/set-a.toml --out dataset --tubes 10 --cases 1-3\n"
      "Formats: docs/formats.md. Ctrl-C finishes the cases under way; the same command goes on.");
  command->callback([arguments] { generate(*arguments); });
}

}  // namespace tanglebin::cli
