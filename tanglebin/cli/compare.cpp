#include "tanglebin/experiment/compare.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> results;
  std::optional<std::string> baseline;
  std::optional<double> fail_below;
  bool json = false;
};

nlohmann::ordered_json json_of(const Contestant& contestant) {
  return {{"results", contestant.results.string()}, {"method", contestant.method}};
}

nlohmann::ordered_json json_of(const MeasureDifference& measure) {
  return {{"measure", measure.measure},
          {"baseline", measure.baseline},
          {"other", measure.other},
          {"difference", measure.difference},
          {"interval", {measure.low, measure.high}}};
}

nlohmann::ordered_json json_of(const std::vector<SceneDifference>& scenes) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const SceneDifference& scene : scenes) {
    json.push_back({{"set", scene.scene.set},
                    {"tubes", scene.scene.tubes},
                    {"case", scene.scene.number},
                    {"baseline", scene.baseline},
                    {"other", scene.other},
                    {"difference", scene.difference()}});
  }
  return json;
}

void print_json(const Comparison& comparison) {
  nlohmann::ordered_json json{{"baseline", json_of(comparison.baseline)},
                              {"other", json_of(comparison.other)},
                              {"scenes", comparison.scenes},
                              {"unpaired_runs", comparison.unpaired}};
  for (const MeasureDifference& measure : comparison.measures) json["measures"].push_back(json_of(measure));
  json["better"] = json_of(comparison.better);
  json["worse"] = json_of(comparison.worse);
  print_json_line(json);
}

// "A10/3 +0.0123 (0.9500 to 0.9623)".
std::string text_of(const SceneDifference& scene) {
  return fmt::format("{} {:+.4f} ({:.4f} to {:.4f})", name_of(scene.scene), scene.difference(),
                     scene.baseline, scene.other);
}

void print_scenes(const char* what, const std::vector<SceneDifference>& scenes) {
  constexpr std::size_t most_shown = 10;
  print_out("{} in {}{}\n", what, counted(scenes.size(), "scene"), scenes.empty() ? "" : ":");
  for (std::size_t i = 0; i < std::min(scenes.size(), most_shown); ++i)
    print_out("  {}\n", text_of(scenes[i]));
  if (scenes.size() > most_shown) print_out("  and {} more, with --json\n", scenes.size() - most_shown);
}

void print_text(const Comparison& comparison) {
  const auto& [baseline, other] = std::pair(comparison.baseline, comparison.other);
  print_out("{} ({}) compared with {} ({}), {}\n", other.method, other.results.string(), baseline.method,
            baseline.results.string(), counted(comparison.scenes, "scene"));
  if (comparison.unpaired > 0)
    print_out("left out: {} that only one of them has\n", counted(comparison.unpaired, "run"));
  print_out("{:<20} {:>9} {:>9} {:>11}   {}\n", "mean over scenes", "baseline", "other", "difference",
            "95 % interval");
  for (const MeasureDifference& measure : comparison.measures) {
    print_out("{:<20} {:>9.4f} {:>9.4f} {:>+11.4f}   {:+.4f} to {:+.4f}\n", measure.measure, measure.baseline,
              measure.other, measure.difference, measure.low, measure.high);
  }
  print_scenes("a better micro-recall", comparison.better);
  print_scenes("a worse micro-recall", comparison.worse);
}

void compare_results(const CompareArguments& arguments) {
  const std::vector<std::filesystem::path> results(arguments.results.begin(), arguments.results.end());
  bool is_below = false;
  const auto pairs =
      with_option("--baseline", "baseline", [&] { return pairs_to_compare(results, arguments.baseline); });
  for (const auto& [baseline, other] : pairs) {
    const Comparison comparison = compare(baseline, other);
    if (arguments.json)
      print_json(comparison);
    else
      print_text(comparison);
    const double difference = comparison.measures.front().difference;
    is_below = is_below || (arguments.fail_below && difference < *arguments.fail_below);
  }
  if (is_below) throw CLI::RuntimeError(exit_below);
}

}  // namespace

void add_compare(CLI::App& app) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Compare methods scene by scene: paired differences, with intervals, of results of one dataset");
  command
      ->add_option(
          "results", arguments->results,
          "Directories of results: one, to compare its methods; or several, to compare each method of "
          "the first with the same one in the others")
      ->required();
  command
      ->add_option("--baseline", arguments->baseline,
                   "Method to compare the others with, or in several directories the only one to compare")
      ->option_text("METHOD");
  command
      ->add_option("--fail-below", arguments->fail_below,
                   "Exit with status 7 if a mean difference in micro-recall is below this, such as -0.002")
      ->check(finite_number())
      ->option_text("DIFFERENCE");
  command->add_flag("--json", arguments->json, "Print a line of JSON for each comparison, with all scenes");
  command->footer(
      "Example:\n  tanglebin compare results-of-main results --fail-below -0.002\n"
      "  tanglebin compare results --baseline axis\n"
      "The differences: docs/benchmark.md.");
  command->callback([arguments] { compare_results(*arguments); });
}

}  // namespace tanglebin::cli
