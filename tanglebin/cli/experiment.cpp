#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"
#include "tanglebin/cli/options/many_cases.hpp"
#include "tanglebin/cli/options/model_options.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/cli/options/shard_option.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/terminal/progress_report.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/experiment/run_experiment.hpp"
#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/profile/profile.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/report/write_pictures.hpp"
#include "tanglebin/report/write_scenes.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct ExperimentArguments {
  std::string dataset;
  std::string out;
  std::vector<std::string> methods;
  std::vector<std::string> labels;
  double time_limit = std::chrono::duration<double>(default_limits().time).count();  ///< s
  std::optional<double> memory_limit;                                                ///< GiB
  std::string ratios = "0.1:1.0:0.1";
  std::optional<std::string> scene;
  ManyCases many;
  std::optional<std::string> shard;
  ModelOptions model;
  ProgressStyle progress = ProgressStyle::line;
  int scenes = 3;
  bool keep = false;
  bool json = false;
};

ProcessLimits limits_of(const ExperimentArguments& arguments) {
  ProcessLimits limits = default_limits();
  limits.time = time_limit_of(arguments.time_limit);
  constexpr double gibibyte = 1U << 30U;
  if (arguments.memory_limit) limits.memory = static_cast<std::uint64_t>(*arguments.memory_limit * gibibyte);
  return limits;
}

// The name and what comes after it: "mine=python3 …".
std::pair<std::string, std::string> named(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw InputError({"", 0, option}, excerpt(text), "NAME=…");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// "axis:thin.toml": a method that is built in, and a profile over the experiment's settings; none of a
// command.
std::optional<BuiltIn> built_in(const std::string& text, ModelSettings model) {
  const std::size_t colon = text.find(':');
  const std::vector<Method> known = methods();
  const auto method = std::ranges::find_if(
      known, [&](Method its) { return name_of(its) == std::string_view(text).substr(0, colon); });
  if (colon == std::string::npos || method == known.end()) return std::nullopt;
  const std::string file = text.substr(colon + 1);
  const Profile profile = read_profile(file);
  expect_for(profile, {*method}, file);
  apply(profile, model);
  return BuiltIn{*method, file, model};
}

Entry entry_named(const std::string& text, const ModelSettings& model, const ProcessLimits& limits) {
  const auto [name, what] = named(text, "--method");
  if (const auto own = built_in(what, model)) return {name, *own};
  return {name, command_of(what, std::filesystem::current_path(), limits)};
}

// Of --method, without those that have names of their own; axis if no method is named at all.
std::vector<Method> methods_of(const ExperimentArguments& arguments) {
  std::vector<Method> asked;
  for (const std::string& text : arguments.methods) {
    if (text.find('=') != std::string::npos) continue;
    for (const std::string_view name : split(text, ',')) asked.push_back(method_of(std::string(name)));
  }
  if (arguments.methods.empty() && arguments.labels.empty()) asked.push_back(Method::axis);
  return asked;
}

// Those that are built in, in the order of methods(); then those with names of their own, as they were given.
std::vector<Entry> entries_of(const ExperimentArguments& arguments, const ModelSettings& model) {
  const std::vector<Method> asked = methods_of(arguments);
  std::vector<Entry> others;
  for (const std::string& text : arguments.methods) {
    if (text.find('=') != std::string::npos) others.push_back(entry_named(text, model, limits_of(arguments)));
  }
  for (const std::string& text : arguments.labels) {
    const auto [name, directory] = named(text, "--labels");
    others.push_back(
        {name, LabelsDirectory{std::filesystem::absolute(directory).lexically_normal().string()}});
  }
  std::vector<Entry> entries;
  for (const Method method : methods()) {
    if (std::ranges::find(asked, method) != asked.end()) entries.push_back(entry_of(method));
  }
  std::ranges::move(others, std::back_inserter(entries));
  expect_names(entries);
  return entries;
}

// The files of the profiles that the methods have.
std::set<std::string> profiles_of(const ExperimentSettings& settings) {
  std::set<std::string> files;
  if (!settings.profile.empty()) files.insert(settings.profile);
  for (const Entry& entry : settings.methods) {
    const auto* own = std::get_if<BuiltIn>(&entry.what);
    if (own != nullptr) files.insert(own->profile);
  }
  return files;
}

// In which ways the first of the cases of each set is not what a profile was made for.
void print_doubts_of_profiles(const ExperimentSettings& settings, const Dataset& dataset,
                              const std::vector<CaseId>& wanted) {
  for (const std::string& file : profiles_of(settings)) {
    const Profile profile = read_profile(file);
    std::set<std::string> sets;
    for (const CaseId& id : wanted) {
      if (sets.insert(id.set).second) print_doubts(profile, known_scene(recipe_of(dataset, id), id), file);
    }
  }
}

/// What the results of the wanted cases say, and when.
struct Findings {
  std::vector<MeanMicroRecall> means;
  FailureCounts failures;
  double ratio;
  double seconds;
};

void print_json(const ExperimentArguments& arguments, const ExperimentSummary& summary,
                const Findings& findings) {
  nlohmann::ordered_json json;
  if (arguments.progress == ProgressStyle::json) json["event"] = "end";
  json["directory"] = arguments.out;
  json.update(counts_json(summary.progress));
  json["complete"] = summary.is_complete();
  json["failed_runs"] = findings.failures.failed_runs;
  json["unscored_cases"] = findings.failures.cases_unscored;
  json["seconds"] = findings.seconds;
  json["ratio"] = findings.ratio;
  json["micro_recall"] = nlohmann::ordered_json::array();
  for (const MeanMicroRecall& mean : findings.means) {
    json["micro_recall"].push_back({{"method", mean.method},
                                    {"set", mean.set},
                                    {"scanner", mean.scanner},
                                    {"tubes", mean.tubes},
                                    {"cases", mean.cases},
                                    {"failed", mean.failed},
                                    {"mean", mean.mean}});
  }
  print_json_line(json);
}

// Over which cases a mean is: "10 tubes, 20 cases, 2 failed".
std::string cases_of(const MeanMicroRecall& mean) {
  return fmt::format("{}, {}{}", counted(static_cast<std::size_t>(mean.tubes), "tube"),
                     counted(mean.cases, "case"),
                     mean.failed > 0 ? fmt::format(", {} failed", mean.failed) : "");
}

// A line for each method and set.
void print_means(const std::vector<MeanMicroRecall>& means) {
  const auto same_line = [](const MeanMicroRecall& a, const MeanMicroRecall& b) {
    return a.method == b.method && a.set == b.set && a.scanner == b.scanner;
  };
  for (auto mean = means.begin(); mean != means.end();) {
    print_out("{}, set {}:", mean->method, seen_by(mean->scanner, mean->set));
    const auto first = mean;
    for (; mean != means.end() && same_line(*first, *mean); ++mean) {
      print_out("{} {:.3f} ({})", mean == first ? "" : ",", mean->mean, cases_of(*mean));
    }
    print_out("\n");
  }
}

void print_failures(const FailureCounts& failures, const std::string& directory) {
  if (failures.failed_runs > 0) {
    print_out("{} failed, each a micro-recall of 0; {}/results.jsonl says why\n",
              counted(failures.failed_runs, "run"), directory);
  }
  if (failures.cases_unscored > 0) {
    print_out("{} without a visible tube, in no mean\n", counted(failures.cases_unscored, "case"));
  }
}

void print_text(const ExperimentArguments& arguments, const ExperimentSummary& summary,
                const Findings& findings) {
  if (!findings.means.empty()) print_out("mean micro-recall at ratio {}\n", findings.ratio);
  print_means(findings.means);
  print_failures(findings.failures, arguments.out);
  const RunProgress& run = summary.progress;
  print_out("{}: {} modelled in {:.1f} s, {} already there{}\n", arguments.out, counted(run.made, "case"),
            findings.seconds, run.found, summary.was_stopped() ? left_over(run) : "");
}

void print_left_out(const ModelAgain& model_again) {
  for (const auto& [method, seen] : model_again.left_out()) {
    print_error("tanglebin: {}: {} has more than {} labels, too many for pictures and scenes in 3D\n",
                name_of(seen), method, most_labels_to_show);
  }
}

void experiment(const ExperimentArguments& arguments) {
  expect_no_input("--out", arguments.out, {arguments.dataset});
  const ModelSettings model =
      settings_of(arguments.model, profile_of(arguments.model, methods_of(arguments)));
  ExperimentSettings settings{.methods = entries_of(arguments, model),
                              .ratios = parse_ratios(arguments.ratios, "--downsample"),
                              .model = model,
                              .profile = arguments.model.profile,
                              .keep_models = arguments.keep};
  if (arguments.scene) settings.scene = scene_named(*arguments.scene, "");
  expect_dataset(arguments.dataset);
  const Dataset dataset = read_dataset(arguments.dataset);
  std::vector<CaseId> wanted = chosen(arguments.many, cases(dataset), arguments.dataset);
  if (const std::optional<Shard> shard = shard_of(arguments.shard)) wanted = part_of(*shard, wanted);
  print_doubts_of_profiles(settings, dataset, wanted);
  const Clock::time_point start = Clock::now();
  const ExperimentSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return run_experiment(dataset, settings, wanted, arguments.out, arguments.many.jobs, progress.observer());
  }();
  if (!summary.was_stopped()) {
    ModelAgain model_again(arguments.out, dataset, settings);
    write_pictures(arguments.out, dataset, settings, model_again);
    write_scenes(arguments.out, dataset, settings, static_cast<std::size_t>(arguments.scenes), model_again);
    print_left_out(model_again);
  }
  const ResultsSummary results = summary_of(arguments.out, settings.ratios, wanted);
  const Findings findings{results.means(), results.failures(), results.ratio(), seconds_since(start)};
  if (arguments.json || arguments.progress == ProgressStyle::json)
    print_json(arguments, summary, findings);
  else
    print_text(arguments, summary, findings);
  for (const FailedModel& failed : summary.failed) {
    print_error("tanglebin: {}: failed: {}\n", name_of(failed.id), failed.reason);
  }
  if (summary.was_stopped()) throw CLI::RuntimeError(exit_interrupted());
  if (findings.failures.failed_runs > 0) throw CLI::RuntimeError(exit_cases_failed);
}

}  // namespace

void add_experiment(CLI::App& app) {
  const auto arguments = std::make_shared<ExperimentArguments>();
  CLI::App* command = app.add_subcommand(
      "experiment", "Model and score every case of a dataset, as in the paper's Section 6");
  command->add_option("dataset", arguments->dataset, "Directory of a dataset from `tanglebin generate`")
      ->required();
  command->add_option("--out", arguments->out, "Directory of the results; resumes an interrupted run")
      ->required();
  command
      ->add_option(
          "--method", arguments->methods,
          "Method, as often as there are some: axis, paper or axis,paper; NAME=axis:PROFILE for one with a "
          "profile of its own; NAME='COMMAND {cloud} {out}' for a program of yours, without a shell "
          "(docs/benchmark.md)")
      ->allow_extra_args(false)
      ->option_text("METHOD [axis]");
  command
      ->add_option("--labels", arguments->labels,
                   "NAME=DIRECTORY of labels that exist already, with a file for each case: "
                   "A10/plys/1.ply, A10/labels/1.npy, …")
      ->allow_extra_args(false)
      ->option_text("LABELS");
  command->add_option("--time-limit", arguments->time_limit, "Seconds that a command may take for a cloud")
      ->capture_default_str()
      ->check(number_within(1e-3, 1e9));
  command
      ->add_option("--memory-limit", arguments->memory_limit,
                   "GiB of address space that each process of a command may have")
      ->check(number_within(1e-3, 1e6))
      ->option_text("GIB");
  command
      ->add_option("--downsample", arguments->ratios, "Downsampling ratios: 0.3, 0.1,0.3 or first:last:step")
      ->capture_default_str();
  command
      ->add_option("--scene", arguments->scene,
                   "Scene file with what to tell the methods instead of what the recipe says: another bin or "
                   "camera, tubes whose radius or length is not known")
      ->option_text("FILE");
  add_options(*command, arguments->many);
  add_shard_option(*command, arguments->shard);
  add_options(*command, arguments->model);
  add_progress_option(*command, arguments->progress);
  command
      ->add_option(
          "--scenes", arguments->scenes,
          "How many scenes to keep for the report in 3D: of each method's worst, and of those in which "
          "the methods differ most")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  command->add_flag("--keep", arguments->keep,
                    "Keep the labelled clouds and the tubes, in models/ of the results");
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin experiment dataset --out results --downsample 0.3 --tubes 10 --cases 1-3\n"
      "  tanglebin experiment dataset --out results --method axis --method mine='python3 label.py {cloud} "
      "{out}'\n"
      "Ctrl-C finishes the cases in progress; run the same command again to resume.\n"
      "Exit status: 3 if runs failed, 130 if interrupted.\n"
      "Formats: docs/formats.md. Your own algorithm: docs/benchmark.md.");
  command->callback([arguments] { experiment(*arguments); });
}

}  // namespace tanglebin::cli
