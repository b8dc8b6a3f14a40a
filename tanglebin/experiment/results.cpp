#include "tanglebin/experiment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/io/json_record.hpp"
#include "tanglebin/io/read_file.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/scene/write_scene.hpp"

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

// SHA-256 of the program that runs.
const std::string& program_sha256() {
  static const std::string hash =
      sha256(read_file("/proc/self/exe", std::numeric_limits<std::size_t>::max()));
  return hash;
}

bool is_to_be_tried_again(const RunResult& result) {
  return result.failure && result.failure->of == FailureOf::worker;
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
  const std::optional<RunFailure> failure = failure_in(record);
  return {run_of(record), record.text("case_sha256"), failure ? 0 : record.number("micro_recall"), failure,
          line};
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
  for (const std::string_view part : split(line, separator)) {
    const std::string text(part);
    const bool is_times = JsonRecord(text, file, number).has("seconds");
    (is_times ? add_times : add_result)(finished, text, file, number);
  }
}

// What the methods are told, as a scene file has it; empty if it is what the recipe says.
std::string scene_text(const Scene& scene) {
  std::ostringstream text;
  write_scene(text, scene);
  return std::move(text).str();
}

// Everything that the results depend on, besides the cases themselves.
Json experiment_json(const Dataset& dataset, const ExperimentSettings& settings) {
  Json json{{"version", TANGLEBIN_VERSION},
            {"program_sha256", program_sha256()},
            {"dataset_seed", dataset.recipe.seed}};
  json["methods"] = Json::array();
  for (const Method method : settings.methods) json["methods"].push_back(name_of(method));
  json["ratios"] = settings.ratios;
  json["seed"] = settings.model.seed;
  json["parameters"] = changed_parameters(settings.model);
  json["recipe_sha256"] = dataset.recipe_sha256;
  json["scene"] = scene_text(settings.scene);
  return json;
}

// The text of experiment.json, which also has the number of cases with results.
std::string experiment_text(Json experiment, std::size_t cases) {
  experiment["cases"] = cases;
  return experiment.dump() + '\n';
}

Json result_head(const RunId& run, const std::string& case_sha256) {
  Json json = run_json(run);
  json["case_sha256"] = case_sha256;
  return json;
}

// Calls `take` with every run of the experiment, in the order of the results' lines.
void for_each_run(const std::vector<CaseId>& cases, const ExperimentSettings& settings,
                  const std::function<void(const RunId&)>& take) {
  for (const Method method : settings.methods)
    for (const CaseId& id : cases)
      for (const double ratio : settings.ratios) take({method, id, ratio});
}

}  // namespace

std::string result_json(const RunId& run, const std::string& case_sha256, const Model& model,
                        const ModelScore& score) {
  const auto& [labels, tubes] = score;
  Json json = result_head(run, case_sha256);
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

std::string failure_json(const RunId& run, const std::string& case_sha256, const RunFailure& failure) {
  Json json = result_head(run, case_sha256);
  add_failure(json, failure);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
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
  for_each_run({id}, settings, [&](const RunId& run) {
    const auto found = results.find(run);
    all = all && found != results.end() && !is_to_be_tried_again(found->second);
  });
  return all;
}

void FinishedRuns::forget_changed_cases(const Dataset& dataset) {
  std::map<CaseId, std::string> now;
  for (const auto& [run, result] : results) {
    const CaseId& id = run.scene;
    if (now.contains(id)) continue;
    if (!dataset.catalogue.has(id)) {
      throw InputError({dataset.directory.string(), 0, name_of(id)},
                       "the dataset lacks this case, which the results have; use another directory for its "
                       "results");
    }
    now.emplace(id, case_sha256(dataset, id));
  }
  const auto is_changed = [&](const auto& entry) {
    return entry.second.case_sha256 != now.at(entry.first.scene);
  };
  for (const auto& entry : results) {
    if (is_changed(entry)) times.erase(entry.first);
  }
  std::erase_if(results, is_changed);
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

void expect_free(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings) {
  if (fs::exists(directory / recipe_name))
    throw InputError({directory.string(), 0, ""}, "a dataset", "a directory for results");
  const fs::path file = experiment_of(directory);
  const std::optional<std::string> text = read_if_there(file);
  if (!text) return;
  const JsonRecord found(*text, file.string(), 0);
  const Json wanted = experiment_json(dataset, settings);
  for (const auto& [key, value] : wanted.items()) {
    const Json other = found.json().value(key, Json());
    if (other == value) continue;
    throw InputError({file.string(), 0, key},
                     fmt::format("the directory belongs to another {}: it has {}, this one {}; use another "
                                 "directory",
                                 key == "program_sha256" ? "build of the program" : "experiment",
                                 other.dump(), value.dump()));
  }
}

void claim(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings) {
  expect_free(directory, dataset, settings);
  const fs::path file = experiment_of(directory);
  if (!fs::exists(file)) write_file(file, experiment_text(experiment_json(dataset, settings), 0));
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
