#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/recipe.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct GenerateArguments {
  std::string recipe;
  std::string out;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::optional<std::string> shard;
  std::vector<std::string> sets;
  std::vector<int> tubes;
  std::optional<std::string> cases;
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
  const auto any_of = [](const auto& list, const auto& value) {
    return list.empty() || std::ranges::find(list, value) != list.end();
  };
  std::vector<CaseId> chosen = cases(recipe);
  std::erase_if(chosen, [&](const CaseId& id) {
    return !any_of(arguments.sets, id.set) || !any_of(arguments.tubes, id.tubes);
  });
  if (arguments.cases) {
    const Range range = parse_range(*arguments.cases, "--cases");
    std::erase_if(chosen,
                  [&](const CaseId& id) { return id.number < range.first || id.number > range.last; });
  }
  if (chosen.empty()) {
    throw InputError({arguments.recipe, 0, ""}, "no case has this --set, --tubes and --cases");
  }
  if (arguments.shard) {
    const Shard shard = parse_shard(*arguments.shard, "--shard");
    std::vector<CaseId> part;
    for (auto i = static_cast<std::size_t>(shard.index - 1); i < chosen.size();
         i += static_cast<std::size_t>(shard.count)) {
      part.push_back(chosen[i]);
    }
    chosen = std::move(part);
  }
  return chosen;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One line on the terminal that is written over and over; nothing where standard error is not a terminal.
class ProgressLine {
public:
  explicit ProgressLine(std::size_t total) : total_(total) {}
  ~ProgressLine() {
    if (shown_) fmt::print(stderr, "\n");
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::size_t done) {
    if (!is_terminal_) return;
    if (!shown_) done_at_start_ = done;
    const std::size_t made = done - done_at_start_;
    const double elapsed = seconds_since(start_);
    const double remaining =
        made == 0 ? 0.0 : elapsed / static_cast<double>(made) * static_cast<double>(total_ - done);
    fmt::print(stderr, "\r{} of {} cases, {:.1f} a second, {:.0f} s left \x1b[K", done, total_,
               static_cast<double>(made) / elapsed, remaining);
    shown_ = true;
  }

private:
  std::size_t total_;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool shown_ = false;
  std::size_t done_at_start_ = 0;
  Clock::time_point start_ = Clock::now();
};

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
    return generate_dataset(recipe, wanted, arguments.out, arguments.jobs,
                            [&](std::size_t done) { line.show(done); });
  }();
  print_summary(arguments, summary, seconds_since(start));
  constexpr int interrupted = 130;  // as a shell reports SIGINT
  if (!summary.complete()) throw CLI::RuntimeError(interrupted);
}

}  // namespace

void add_generate(CLI::App& app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app.add_subcommand("generate", "Make a dataset of labelled scans from a recipe");
  command->add_option("recipe", arguments->recipe, "Recipe (TOML); - reads standard input")->required();
  command->add_option("--out", arguments->out, "Directory of the dataset; a run that was stopped goes on")
      ->required();
  command->add_option("--jobs", arguments->jobs, "Processes that work side by side")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  command->add_option("--shard", arguments->shard,
                      "Make the I-th of N parts of the cases (I/N), in a directory of its own");
  command->add_option("--set", arguments->sets, "Only these sets");
  command->add_option("--tubes", arguments->tubes, "Only these numbers of tubes");
  command->add_option("--cases", arguments->cases, "Only this case or range of cases: 3 or 1-20");
  command->add_option("--seed", arguments->seed, "Seed in place of the recipe's")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin generate recipes/set-a.toml --out dataset --tubes 10 --cases 1-3\n"
      "Formats: docs/formats.md. Ctrl-C finishes the cases under way; the same command goes on.");
  command->callback([arguments] { generate(*arguments); });
}

}  // namespace tanglebin::cli
