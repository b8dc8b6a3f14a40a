#include "tanglebin/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/shard_option.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/terminal/progress_report.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct CalibrateArguments {
  std::string recipe;
  std::string out;
  std::string method = name_of(Method::axis);
  std::string objective = name_of(Objective::unmixed_recall);
  std::string ratio = "1";
  std::string budget = "5000";
  std::string start;
  double time_limit = std::chrono::duration<double>(ScoringSettings{}.scene_limit).count();  ///< s
  int scenes = CalibrationSettings{}.scenes;
  int jobs = 1;
  bool json = false;
  ProgressStyle progress = ProgressStyle::line;
};

// "5000" evaluations, or "90s", "10min", "1h" of time.
CalibrationBudget budget_of(const std::string& text) {
  constexpr std::size_t most = 1'000'000'000;
  const std::size_t unit_at = text.find_first_not_of("0123456789");
  const std::string unit = unit_at == std::string::npos ? "" : text.substr(unit_at);
  const std::optional<int> number = to_number<int>(text.substr(0, unit_at));
  const std::map<std::string, int> seconds{{"s", 1}, {"min", 60}, {"h", 3600}};
  const bool is_known = unit.empty() || seconds.contains(unit);
  if (!number || *number < 1 || !is_known)
    throw InputError({"", 0, "--budget"}, excerpt(text),
                     "evaluations, such as 5000, or a time: 90s, 10min, 1h");
  if (unit.empty()) return {.evaluations = static_cast<std::size_t>(*number)};
  return {.evaluations = most, .time = std::chrono::duration<double>(double{1} * *number * seconds.at(unit))};
}

Objective objective_of(const std::string& name) {
  return with_option("--objective", "objective", [&] { return objective_named(name); });
}

CalibrationSettings settings_of(const CalibrateArguments& arguments) {
  const std::vector<double> ratios = parse_ratios(arguments.ratio, "--downsample");
  if (ratios.size() != 1)
    throw InputError({"", 0, "--downsample"}, fmt::format("{} ratios", ratios.size()), "one");
  CalibrationSettings settings{.scoring = {.method = method_of(arguments.method),
                                           .objective = objective_of(arguments.objective),
                                           .ratio = ratios.front(),
                                           .scene_limit = time_limit_of(arguments.time_limit),
                                           .jobs = arguments.jobs},
                               .scenes = arguments.scenes,
                               .budget = budget_of(arguments.budget)};
  if (arguments.start.empty()) return settings;
  const Profile start = read_profile(arguments.start);
  expect_for(start, {settings.scoring.method}, arguments.start);
  settings.start = start.parameters;
  return settings;
}

// Beside the profile: "hose.toml" has "hose.calibration".
std::filesystem::path directory_of(const CalibrateArguments& arguments) {
  return std::filesystem::path(arguments.out).replace_extension(".calibration");
}

/// Shows how far the calibration is, once its scenes are there: as ProgressReport does for cases.
class CalibrationReport {
public:
  explicit CalibrationReport(ProgressStyle style) : style_(style) {}
  ~CalibrationReport() {
    if (is_shown_) print_error("\n");
  }
  CalibrationReport(const CalibrationReport&) = delete;
  CalibrationReport& operator=(const CalibrationReport&) = delete;

  void show(const CalibrationProgress& progress) {
    if (style_ == ProgressStyle::json) {
      print_progress(progress);
    } else if (is_terminal_) {
      print_error("\r{} \x1b[K", text(progress));
      is_shown_ = true;
    } else if (schedule_.is_due(seconds_since(begun_), share(progress))) {
      print_error("tanglebin: {}\n", text(progress));
    }
  }

private:
  static double share(const CalibrationProgress& progress) {
    return static_cast<double>(progress.evaluations) /
           static_cast<double>(std::max<std::size_t>(1, progress.most));
  }

  static std::string text(const CalibrationProgress& progress) {
    std::string result = fmt::format("{}: {} evaluations", progress.step, progress.evaluations);
    if (progress.before > 0)
      result += fmt::format(", {:.4f}, at first {:.4f}", progress.best, progress.before);
    if (progress.left) result += fmt::format(", at most {} left", duration_text(progress.left->count()));
    return result;
  }

  void print_progress(const CalibrationProgress& progress) {
    if (Clock::now() - last_printed_ < std::chrono::seconds(1)) return;
    last_printed_ = Clock::now();
    nlohmann::ordered_json event{{"event", "evaluations"},       {"step", progress.step},
                                 {"done", progress.evaluations}, {"most", progress.most},
                                 {"before", progress.before},    {"best", progress.best},
                                 {"remaining_seconds", nullptr}};
    if (progress.left) event["remaining_seconds"] = progress.left->count();
    print_json_line(event);
    std::fflush(stdout);  // a program at the other end of a pipe gets it at once
  }

  ProgressStyle style_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point last_printed_{};
  LogSchedule schedule_{};
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
};

std::optional<Calibration> run(const CalibrateArguments& arguments, const Recipe& recipe,
                               const CalibrationSettings& settings) {
  ProgressReport scenes(arguments.progress);
  CalibrationReport report(arguments.progress);
  const CalibrationObserver observer{
      .scenes = scenes.observer(),
      .progress = [&](const CalibrationProgress& progress) { report.show(progress); },
      .stopping = [] { print_error("\ntanglebin: stopping; run the same command again to go on\n"); }};
  return with_file(arguments.recipe,
                   [&] { return calibrate(recipe, settings, directory_of(arguments), observer); });
}

void write_result(const CalibrateArguments& arguments, const Calibration& calibration) {
  const std::string title =
      fmt::format("Parameters of the method {}, calibrated by tanglebin {} for {} (docs/calibration.md)",
                  arguments.method, calibration.profile.made_for->version, arguments.recipe);
  write_output(arguments.out,
               bytes_of([&](std::ostream& out) { write_profile(out, calibration.profile, title); }));
}

nlohmann::ordered_json json_of(const Estimate& estimate) {
  return {{"mean", estimate.mean}, {"low", estimate.low}, {"high", estimate.high}};
}

void print_json(const CalibrateArguments& arguments, const Calibration& calibration) {
  const Reached& reached = *calibration.profile.reached;
  nlohmann::ordered_json json;
  if (arguments.progress == ProgressStyle::json) json["event"] = "end";
  json.update({{"profile", arguments.out},
               {"evaluations", calibration.evaluations},
               {"better", calibration.is_better},
               {"objective", reached.objective},
               {"scenes", reached.scenes},
               {"before", json_of(reached.before)},
               {"after", json_of(reached.after)},
               {"difference", json_of(reached.difference)},
               {"parameters", calibration.profile.parameters},
               {"sensitivities", nlohmann::ordered_json::array()}});
  for (const auto& [name, down, up] : calibration.sensitivities)
    json["sensitivities"].push_back({{"parameter", name}, {"down", down}, {"up", up}});
  print_json_line(json);
}

void print_sensitivities(std::vector<Sensitivity> sensitivities) {
  constexpr std::size_t most_shown = 10;
  const auto effect = [](const Sensitivity& of) { return std::max(std::abs(of.down), std::abs(of.up)); };
  std::ranges::stable_sort(sensitivities, std::ranges::greater(), effect);
  std::erase_if(sensitivities, [&](const Sensitivity& of) { return effect(of) == 0; });
  if (!sensitivities.empty())
    print_out("{:<36} {:>8} {:>8}\n", "moves the score most, if moved", "down", "up");
  for (std::size_t i = 0; i < std::min(most_shown, sensitivities.size()); ++i) {
    const auto& [name, down, up] = sensitivities[i];
    print_out("  {:<34} {:>+8.4f} {:>+8.4f}\n", name, down, up);
  }
}

void print_text(const CalibrateArguments& arguments, const Calibration& calibration, double seconds) {
  print_sensitivities(calibration.sensitivities);
  const Reached& reached = *calibration.profile.reached;
  print_out("{} on {} scenes that it was not calibrated on, with 95 % intervals\n", reached.objective,
            reached.scenes);
  const auto& [before, after, difference] = std::tie(reached.before, reached.after, reached.difference);
  print_out("  before      {:>7.4f}   {:.4f} to {:.4f}\n", before.mean, before.low, before.high);
  print_out("  after       {:>7.4f}   {:.4f} to {:.4f}\n", after.mean, after.low, after.high);
  print_out("  difference {:>+8.4f}   {:+.4f} to {:+.4f}\n", difference.mean, difference.low,
            difference.high);
  if (!calibration.is_better) print_out("nothing found that is better there: the start is kept\n");
  print_out("{}: {} parameters, {} evaluations, {:.1f} s\n", arguments.out,
            calibration.profile.parameters.size(), calibration.evaluations, seconds);
}

void calibrate_method(const CalibrateArguments& arguments) {
  expect_outputs({{"--out", arguments.out, {".toml"}}}, {arguments.recipe, arguments.start});
  if (arguments.out == standard_stream)
    throw InputError({"", 0, "--out"}, "'-'", "a file: what is done is kept beside it");
  const Recipe recipe = read_input(arguments.recipe, [](auto&&... from) { return read_recipe(from...); });
  if (recipe.random.empty()) with_file(arguments.recipe, [&] { expect_bin_in_view(recipe); });
  const CalibrationSettings settings = settings_of(arguments);
  const Clock::time_point start = Clock::now();
  const std::optional<Calibration> calibration = run(arguments, recipe, settings);
  if (!calibration) throw CLI::RuntimeError(exit_interrupted());
  write_result(arguments, *calibration);
  if (arguments.json || arguments.progress == ProgressStyle::json)
    print_json(arguments, *calibration);
  else
    print_text(arguments, *calibration, seconds_since(start));
}

}  // namespace

void add_calibrate(CLI::App& app) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Fit a method's parameters to the tubes, the bin and the scanner of a recipe");
  command->add_option("recipe", arguments->recipe, "Recipe (TOML); - for standard input")->required();
  command
      ->add_option("--out", arguments->out,
                   "Profile (.toml) to write, for --profile of model and experiment; a directory beside it, "
                   "such as hose.calibration, keeps what is done")
      ->required();
  command->add_option("--method", arguments->method, "Method: axis or paper")->capture_default_str();
  command
      ->add_option("--objective", arguments->objective,
                   "What to maximize: unmixed_recall, micro_recall, panoptic_quality or complete_tubes "
                   "(docs/metrics.md)")
      ->capture_default_str();
  command
      ->add_option("--time-limit", arguments->time_limit,
                   "Seconds for a scene; one that takes longer scores 0")
      ->capture_default_str()
      ->check(number_within(1e-3, 1e9));
  command->add_option("--downsample", arguments->ratio, "Downsampling ratio: 0.3")->capture_default_str();
  command
      ->add_option("--scenes", arguments->scenes,
                   "How many scenes to calibrate on; as many others show what it is worth")
      ->check(whole_number(2, 100000))
      ->capture_default_str();
  command
      ->add_option(
          "--budget", arguments->budget,
          "When to stop the search: after so many evaluations, each a scene modelled once, or so that "
          "all is done after a time such as 10min, which may give other parameters each time")
      ->capture_default_str();
  command
      ->add_option("--start", arguments->start,
                   "Profile to start from, and to compare with, instead of the defaults")
      ->option_text("FILE");
  add_jobs_option(*command, arguments->jobs);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->footer(
      "Example:\n  tanglebin calibrate recipes/set-a.toml --out mine.toml --scenes 5 --budget 1000\n"
      "Ctrl-C stops it; run the same command again to go on.\n"
      "Exit status: 130 if interrupted.\n"
      "Guide: docs/calibration.md.");
  command->callback([arguments] { calibrate_method(*arguments); });
}

}  // namespace tanglebin::cli
