#include "tanglebin/experiment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/io/json_record.hpp"
#include "tanglebin/io/read_file.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/runs/journal.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

fs::path experiment_of(const fs::path& directory) {
  return directory / "experiment.json";
}
fs::path results_of(const fs::path& directory) {
  return directory / "results.jsonl";
}
fs::path times_of(const fs::path& directory) {
  return directory / "times.jsonl";
}

// Separates the lines of a case in the journal; inside the lines, JSON escapes tabs.
constexpr char separator = '\t';

Json run_json(const RunId& run) {
  Json json = id_json(run.scene);
  json["method"] = name_of(run.method);
  json["ratio"] = run.ratio;
  return json;
}

RunId run_of(const JsonRecord& record) {
  return {method_named(record.text("method")), id_of(record), record.number("ratio")};
}

RunResult run_result(const std::string& line, const std::string& file, std::size_t number) {
  const JsonRecord record(line, file, number);
  return {run_of(record), record.number("micro_recall"), line};
}

void add_result(FinishedRuns& finished, const std::string& line, const std::string& file,
                std::size_t number) {
  RunResult result = run_result(line, file, number);
  const RunId run = result.run;
  finished.results.insert_or_assign(run, std::move(result));
}

void add_times(FinishedRuns& finished, const std::string& line, const std::string& file, std::size_t number) {
  finished.times.insert_or_assign(run_of({line, file, number}), line);
}

void add_journal_line(FinishedRuns& finished, const std::string& line, const std::string& file,
                      std::size_t number) {
  std::istringstream parts(line);
  std::string result;
  std::string times;
  while (std::getline(parts, result, separator)) {
    if (!std::getline(parts, times, separator))
      throw InputError({file, number, ""}, "a result without times", "both, separated by a tab");
    add_result(finished, result, file, number);
    add_times(finished, times, file, number);
  }
}

// Everything that the results depend on.
Json experiment_json(const Dataset& dataset, const ExperimentSettings& settings) {
  Json json{{"version", TANGLEBIN_VERSION}, {"dataset_seed", dataset.recipe.seed}};
  json["methods"] = Json::array();
  for (const Method method : settings.methods) json["methods"].push_back(name_of(method));
  json["ratios"] = settings.ratios;
  json["seed"] = settings.model.seed;
  json["parameters"] = changed_parameters(settings.model);
  json["recipe_sha256"] = dataset.recipe_sha256;
  return json;
}

// The text of experiment.json, which also has the number of cases with results.
std::string experiment_text(Json experiment, std::size_t cases) {
  experiment["cases"] = cases;
  return experiment.dump() + '\n';
}

// Calls `take` with every run of the experiment, in the order of the results' lines.
void for_each_run(const std::vector<CaseId>& cases, const ExperimentSettings& settings,
                  const std::function<void(const RunId&)>& take) {
  for (const Method method : settings.methods)
    for (const CaseId& id : cases)
      for (const double ratio : settings.ratios) take({method, id, ratio});
}

}  // namespace

std::string result_json(const RunId& run, const Model& model, const ModelScore& score) {
  const auto& [labels, tubes] = score;
  Json json = run_json(run);
  json["points"] = labels.points;
  json["micro_recall"] = labels.micro_recall;
  json["mean_iou"] = labels.mean_iou;
  json["precision"] = labels.detection.precision;
  json["recall"] = labels.detection.recall;
  json["f1"] = labels.detection.f1;
  json["panoptic_quality"] = labels.detection.panoptic_quality;
  json["adjusted_rand_index"] = labels.adjusted_rand_index;
  json["correct"] = labels.instances.correct;
  json["over_segmented"] = labels.instances.over_segmented;
  json["under_segmented"] = labels.instances.under_segmented;
  json["missed"] = labels.instances.missed;
  json["noise"] = labels.instances.noise;
  json["tubes_found"] = model.tubes.size();
  json["centre_line_error"] = tubes.centre_line_error ? Json(*tubes.centre_line_error) : Json();
  json["centre_line_coverage"] = tubes.centre_line_coverage;
  json["complete_tubes"] = tubes.complete_tubes;
  json["length_error"] = tubes.length_error ? Json(*tubes.length_error) : Json();
  json["true_joins"] = tubes.true_joins;
  json["joins_found"] = tubes.joins_found;
  json["joins_made"] = tubes.joins_made;
  json["true_junctions"] = tubes.true_junctions;
  json["junctions_found"] = tubes.junctions_found;
  json["junctions_made"] = tubes.junctions_made;
  json["counts"] = Json::object();
  for (const Step& step : model.steps) json["counts"][step.name] = step.count;
  return json.dump();
}

std::string times_json(const RunId& run, const Model& model, double seconds) {
  Json json = run_json(run);
  json["seconds"] = seconds;
  json["steps"] = Json::object();
  for (const Step& step : model.steps) json["steps"][step.name] = step.seconds;
  return json.dump();
}

std::string journal_line(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, std::string(1, separator)));
}

bool FinishedRuns::has(const CaseId& id, const ExperimentSettings& settings) const {
  bool all = true;
  for_each_run({id}, settings, [&](const RunId& run) { all = all && results.contains(run); });
  return all;
}

FinishedRuns finished_runs(const fs::path& directory) {
  FinishedRuns finished;
  const auto read = [&](const fs::path& file, const auto& add) {
    for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
      add(finished, line, file.string(), number);
    });
  };
  read(results_of(directory), add_result);
  read(times_of(directory), add_times);
  for (const fs::path& journal : journals_in(directory)) {
    for_each_readable_line(journal, [&](const std::string& line, std::size_t number) {
      add_journal_line(finished, line, journal.string(), number);
    });
  }
  return finished;
}

void claim(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings) {
  if (fs::exists(directory / "recipe.toml"))
    throw InputError({directory.string(), 0, ""}, "a dataset", "a directory for results");
  const fs::path file = experiment_of(directory);
  const Json wanted = experiment_json(dataset, settings);
  if (!fs::exists(file)) {
    write_file(file, experiment_text(wanted, 0));
    return;
  }
  const JsonRecord found(read_file(file), file.string(), 1);
  for (const auto& [key, value] : wanted.items()) {
    const Json other = found.json().value(key, Json());
    if (other == value) continue;
    throw InputError({file.string(), 0, key},
                     fmt::format("the directory belongs to another experiment: it has {}, this one {}",
                                 other.dump(), value.dump()));
  }
}

void write_results(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings,
                   const FinishedRuns& finished) {
  const std::vector<CaseId> all = cases(dataset.recipe);
  const auto count = std::ranges::count_if(all, [&](const CaseId& id) { return finished.has(id, settings); });
  std::string results;
  std::string times;
  for_each_run(all, settings, [&](const RunId& run) {
    if (const auto found = finished.results.find(run); found != finished.results.end())
      results += found->second.json + '\n';
    if (const auto found = finished.times.find(run); found != finished.times.end())
      times += found->second + '\n';
  });
  StagedFile generation(directory / "generation.jsonl", directory);
  dataset.catalogue.for_each_times_line(all,
                                        [&](const std::string& line) { generation.append(line + '\n'); });
  generation.commit();
  write_file(times_of(directory), times);
  write_file(results_of(directory), results);
  write_file(experiment_of(directory),
             experiment_text(experiment_json(dataset, settings), static_cast<std::size_t>(count)));
}

std::vector<RunResult> read_results(const fs::path& directory) {
  const fs::path file = results_of(directory);
  std::vector<RunResult> results;
  for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
    results.push_back(run_result(line, file.string(), number));
  });
  return results;
}

}  // namespace tanglebin
