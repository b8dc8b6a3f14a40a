#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/exit_status.hpp"
#include "tanglebin/cli/many_cases.hpp"
#include "tanglebin/cli/model_options.hpp"
#include "tanglebin/cli/print.hpp"
#include "tanglebin/cli/progress_report.hpp"
#include "tanglebin/cli/scene_options.hpp"
#include "tanglebin/experiment/run_experiment.hpp"
#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/report/write_pictures.hpp"

namespace tanglebin::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct ExperimentArguments {
  std::string dataset;
  std::string out;
  std::vector<std::string> methods = {name_of(Method::axis)};
  std::string ratios = "0.1:1.0:0.1";
  std::optional<std::string> scene;
  ManyCases many;
  ModelOptions model;
  ProgressStyle progress = ProgressStyle::line;
  bool keep = false;
  bool json = false;
};

// In the order of methods().
std::vector<Method> methods_of(const ExperimentArguments& arguments) {
  std::vector<Method> asked;
  for (const std::string& name : arguments.methods) asked.push_back(method_named(name));
  std::vector<Method> result = methods();
  std::erase_if(result, [&](Method method) { return std::ranges::find(asked, method) == asked.end(); });
  return result;
}

/// What the results say, and when.
struct Findings {
  std::vector<MeanMicroRecall> means;
  FailureCounts failures;
  double ratio;
  double seconds;
};

void print_json(const ExperimentArguments& arguments, const ExperimentSummary& summary,
                const Findings& findings) {
  const RunProgress& run = summary.progress;
  nlohmann::ordered_json json;
  if (arguments.progress == ProgressStyle::json) json["event"] = "end";
  json["directory"] = arguments.out;
  json["wanted"] = run.wanted;
  json["found"] = run.found;
  json["made"] = run.made;
  json["failed"] = run.failed;
  json["complete"] = summary.is_complete();
  json["failed_runs"] = findings.failures.failed_runs;
  json["unscored_cases"] = findings.failures.cases_unscored;
  json["seconds"] = findings.seconds;
  json["ratio"] = findings.ratio;
  json["micro_recall"] = nlohmann::ordered_json::array();
  for (const MeanMicroRecall& mean : findings.means) {
    json["micro_recall"].push_back({{"method", name_of(mean.method)},
                                    {"set", mean.set},
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
    return a.method == b.method && a.set == b.set;
  };
  for (auto mean = means.begin(); mean != means.end();) {
    print_out("{}, set {}:", name_of(mean->method), mean->set);
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
  print_out("{}: {} cases modelled in {:.1f} s, {} already there{}\n", arguments.out, run.made,
            findings.seconds, run.found,
            summary.was_stopped()
                ? fmt::format("; stopped, {} to go", run.wanted - run.found - run.made - run.failed)
                : "");
}

void experiment(const ExperimentArguments& arguments) {
  ExperimentSettings settings{.methods = methods_of(arguments),
                              .ratios = parse_ratios(arguments.ratios, "--downsample"),
                              .model = settings_of(arguments.model),
                              .keep_models = arguments.keep};
  if (arguments.scene) settings.scene = scene_named(*arguments.scene, "");
  expect_dataset(arguments.dataset);
  const Dataset dataset = read_dataset(arguments.dataset);
  const std::vector<CaseId> wanted = chosen(arguments.many, cases(dataset), arguments.dataset);
  const Clock::time_point start = Clock::now();
  const ExperimentSummary summary = [&] {
    ProgressReport progress(arguments.progress);
    return run_experiment(dataset, settings, wanted, arguments.out, arguments.many.jobs, progress.observer());
  }();
  if (!summary.was_stopped()) write_pictures(arguments.out, dataset, settings);
  const std::vector<RunResult> results = read_results(arguments.out);
  const double ratio = ratio_to_show(settings.ratios);
  const Findings findings{mean_micro_recalls(results, ratio), count_failures(results), ratio,
                          seconds_since(start)};
  const auto report = arguments.json || arguments.progress == ProgressStyle::json ? print_json : print_text;
  report(arguments, summary, findings);
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
  command->add_option("--method", arguments->methods, "Methods: axis, paper or axis,paper")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->option_text("NAMES [axis]");
  command
      ->add_option("--downsample", arguments->ratios, "Downsampling ratios: 0.3, 0.1,0.3 or first:last:step")
      ->capture_default_str();
  command
      ->add_option("--scene", arguments->scene,
                   "Scene file with what to tell the methods instead of what the recipe says: another bin or "
                   "camera, tubes whose radius or length is not known")
      ->option_text("FILE");
  add_options(*command, arguments->many);
  add_options(*command, arguments->model);
  add_progress_option(*command, arguments->progress);
  command->add_flag("--keep", arguments->keep,
                    "Keep the labelled clouds and the tubes, in models/ of the results");
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->footer(
      "Example:\n  tanglebin experiment dataset --out results --downsample 0.3 --tubes 10 --cases 1-3\n"
      "Ctrl-C finishes the cases in progress; run the same command again to resume.\n"
      "Exit status: 3 if runs failed, 130 if interrupted.\n"
      "Formats: docs/formats.md.");
  command->callback([arguments] { experiment(*arguments); });
}

}  // namespace tanglebin::cli
