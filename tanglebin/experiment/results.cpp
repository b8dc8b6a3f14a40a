#include "tanglebin/experiment/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/versions.hpp"
#include "tanglebin/experiment/measures.hpp"
#include "tanglebin/experiment/tables.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/scene/write_scene.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr const char* results_name = "results.jsonl";
constexpr const char* generation_name = "generation.jsonl";

// Separates the lines of a case in the journal; inside the lines, JSON escapes tabs.
constexpr char separator = '\t';

Json run_json(const RunId& run) {
  Json json = id_json(run.scene);
  if (!run.scanner.empty()) json["scanner"] = run.scanner;
  json["method"] = run.method;
  json["ratio"] = run.ratio;
  return json;
}

RunId run_of(const JsonRecord& record) {
  return {record.text("method"), id_of(record), record.number("ratio"),
          record.text_if_there("scanner").value_or("")};
}

RunResult run_result(const JsonRecord& record) {
  const std::optional<RunFailure> failure = failure_in(record);
  return {.run = run_of(record),
          .case_sha256 = record.text("case_sha256"),
          .micro_recall = failure ? 0 : record.number("micro_recall"),
          .failure = failure,
          .labels_sha256 = record.text_if_there("labels_sha256")};
}

Json result_head(const RunId& run, const CaseRecord& scene) {
  Json json = run_json(run);
  json["case_sha256"] = sha256(to_json(scene));
  for (const DrawnNumber& number : scene.drawn) {
    if (number.tube == 0) json["drawn"][number.path] = number.value;
  }
  return json;
}

// ---- experiment.json

// What the methods are told, as a scene file has it; empty if it is what the recipe says.
std::string scene_text(const Scene& scene) {
  return bytes_of([&](std::ostream& out) { write_scene(out, scene); });
}

Json limits_json(const ProcessLimits& limits) {
  Json json;
  json["time_limit"] = std::chrono::duration<double>(limits.time).count();
  json["memory_limit"] = number_or_null(limits.memory);
  json["disk_limit"] = number_or_null(limits.disk);
  return json;
}

Json json_of(const Command& command) {
  Json json{{"command", command.text}};
  json.update(limits_json(command.limits));
  json["sha256"] = Json::object();
  for (const auto& [file, sha256] : command.sha256) json["sha256"][file] = sha256;
  return json;
}

Json json_of(const BuiltIn& own) {
  return {{"method", name_of(own.method)},
          {"profile", own.profile},
          {"parameters", changed_parameters(own.model)}};
}

// Of the methods that are not built in as they are, by name.
Json others_json(const std::vector<Entry>& entries) {
  Json json = Json::object();
  for (const Entry& entry : entries) {
    if (const auto* command = std::get_if<Command>(&entry.what)) json[entry.name] = json_of(*command);
    if (const auto* own = std::get_if<BuiltIn>(&entry.what)) json[entry.name] = json_of(*own);
    if (const auto* labels = std::get_if<LabelsDirectory>(&entry.what))
      json[entry.name] = {{"labels", labels->path}};
  }
  return json;
}

std::vector<std::string> names_of(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

// Everything that the results depend on, besides the cases themselves.
Json experiment_json(const Dataset& dataset, const ExperimentSettings& settings) {
  Json json{{"version", TANGLEBIN_VERSION},
            {"program_sha256", program_sha256()},
            {"dataset_seed", dataset.recipe.seed}};
  json["methods"] = names_of(settings.methods);
  json["other_methods"] = others_json(settings.methods);
  json["ratios"] = settings.ratios;
  json["seed"] = settings.model.seed;
  if (!settings.profile.empty()) json["profile"] = settings.profile;
  json["parameters"] = changed_parameters(settings.model);
  json["recipe_sha256"] = dataset.recipe_sha256;
  json["scene"] = scene_text(settings.scene);
  json["recipe"] = read_file(dataset.directory / recipe_name);
  return json;
}

/// Where the dataset was when the results were last written, and its digest; null if unknown.
struct DatasetPlace {
  Json directory;
  Json digest;
};

DatasetPlace place_of(const Dataset& dataset) {
  const std::optional<DatasetSummary> summary = read_dataset_summary(dataset.directory);
  return {dataset.directory.string(), summary ? Json(summary->digest) : Json()};
}

// The text of experiment.json, which also has the dataset's place and the number of cases with results.
std::string experiment_text(Json experiment, const DatasetPlace& place, std::size_t cases) {
  experiment["dataset"] = place.directory;
  experiment["dataset_digest"] = place.digest;
  experiment["cases"] = cases;
  return json_text(experiment) + '\n';
}

JsonRecord read_experiment(const fs::path& directory) {
  const fs::path file = directory / experiment_name;
  return {read_file(file), file.string(), 0};
}

// Of the file, and the same of another one.
void expect_same_experiment(const Json& wanted, const JsonRecord& found, const fs::path& directory,
                            const std::string& remedy) {
  for (const auto& [key, value] : wanted.items()) {
    const Json other = found.json().value(key, Json());
    if (json_text(other) == json_text(value)) continue;
    throw InputError({(directory / experiment_name).string(), 0, key},
                     fmt::format("the directory belongs to another {}: it has {}, this one {}{}",
                                 key == "program_sha256" ? "build of the program" : "experiment",
                                 json_text(other), json_text(value), remedy));
  }
}

std::vector<std::string> names_of_scanners(const Recipe& recipe) {
  std::vector<std::string> names;
  for (const Scanner& scanner : scanners(recipe)) names.push_back(scanner.name);
  return names;
}

RunGrid grid_of(const JsonRecord& experiment, const Recipe& recipe) {
  constexpr double least = std::numeric_limits<double>::min();
  return {experiment.texts("methods"), experiment.numbers("ratios", least, 1), names_of_scanners(recipe)};
}

template <typename Value>
std::size_t position_in(const std::vector<Value>& values, const Value& value, const char* field) {
  const auto found = std::ranges::find(values, value);
  if (found == values.end())
    throw InputError({"", 0, field}, excerpt(fmt::format("{}", value)),
                     fmt::format("{}", fmt::join(values, ", ")));
  return static_cast<std::size_t>(found - values.begin());
}

}  // namespace

// ---- lines

Circumstances circumstances(int jobs) {
  Circumstances now{.processor = {}, .jobs = jobs};
  constexpr std::string_view key = "model name";
  for_each_line("/proc/cpuinfo", [&](const FileLine& line) {
    const std::size_t colon = line.text.find(": ");
    if (now.processor.empty() && line.text.starts_with(key) && colon != std::string::npos)
      now.processor = line.text.substr(colon + 2);
  });
  getloadavg(&now.load, 1);
  return now;
}

std::string result_json(const RunId& run, const CaseRecord& scene, const Modelled& modelled,
                        const ModelScore& score) {
  Json json = result_head(run, scene);
  if (modelled.labels_sha256) json["labels_sha256"] = *modelled.labels_sha256;
  json.update(measures_json(score.labels));
  if (score.tubes) {
    json["tubes_found"] = modelled.model.tubes.size();
    json.update(measures_json(*score.tubes));
  }
  json["each_tube"] = Json::array();
  for (const TubeScore& tube : score.labels.tubes) json["each_tube"].push_back(tube_json(tube));
  json["counts"] = Json::object();
  for (const Step& step : modelled.model.steps) json["counts"][step.name] = step.count;
  return json_text(json);
}

std::string failure_json(const RunId& run, const CaseRecord& scene, const RunFailure& failure,
                         const std::optional<std::string>& labels_sha256) {
  Json json = result_head(run, scene);
  add_failure(json, failure);
  if (labels_sha256) json["labels_sha256"] = *labels_sha256;
  return json_text(json);
}

std::string times_json(const RunId& run, const Modelled& modelled, const Circumstances& circumstances) {
  Json json = run_json(run);
  json["seconds"] = modelled.seconds.value_or(0);
  json["steps"] = Json::object();
  for (const Step& step : modelled.model.steps) json["steps"][step.name] = step.seconds;
  json["processor"] = circumstances.processor;
  json["jobs"] = circumstances.jobs;
  json["load"] = circumstances.load;
  return json_text(json);
}

std::string journal_line(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, std::string(1, separator)));
}

// ---- finished runs

RunId RunGrid::run(std::size_t index, const CaseId& id) const {
  const std::size_t view = index / ratios.size();
  return {methods[view / scanners.size()], id, ratios[index % ratios.size()],
          scanners[view % scanners.size()]};
}

std::size_t RunGrid::index_of(const RunId& run) const {
  const std::size_t method = position_in(methods, run.method, "method");
  const std::size_t scanner = position_in(scanners, run.scanner, "scanner");
  return (method * scanners.size() + scanner) * ratios.size() + position_in(ratios, run.ratio, "ratio");
}

RunGrid grid_of(const ExperimentSettings& settings, const Recipe& recipe) {
  return {names_of(settings.methods), settings.ratios, names_of_scanners(recipe)};
}

void FinishedRuns::add(const fs::path& directory) {
  const auto read = [&](const fs::path& file, const auto& for_each_line_of, auto add_line) {
    const std::size_t index = files_.size();
    files_.push_back(file);
    std::uint64_t offset = 0;
    for_each_line_of(file, [&](const std::string& line, std::size_t number) {
      const LinePlace place{index, offset, line.size(), number};
      offset += line.size() + 1;
      (this->*add_line)(line, place);
    });
  };
  read(directory / results_name, for_each_whole_line, &FinishedRuns::add_result);
  read(directory / times_name, for_each_whole_line, &FinishedRuns::add_times);
  for (const fs::path& journal : journals_in(directory))
    read(journal, for_each_readable_line, &FinishedRuns::add_journal_line);
}

void FinishedRuns::add_result(const std::string& line, const LinePlace& place) {
  const std::string file = files_[place.file].string();
  const RunResult result = run_result({line, file, place.line});
  const std::size_t index = with_file(file, [&] { return grid_.index_of(result.run); });
  Case& its = cases_[result.run.scene];
  if (its.sha256 != result.case_sha256) its = {result.case_sha256, std::vector<Run>(grid_.size())};
  State state = State::scored;
  if (result.failure) {
    state = result.failure->of == FailureOf::worker ? State::to_be_tried_again : State::failed;
  }
  its.runs[index] = {.result = place, .state = state, .has_labels_sha256 = result.labels_sha256.has_value()};
}

void FinishedRuns::add_times(const std::string& line, const LinePlace& place) {
  const std::string file = files_[place.file].string();
  const RunId run = run_of({line, file, place.line});
  const std::size_t index = with_file(file, [&] { return grid_.index_of(run); });
  const auto its = cases_.find(run.scene);
  if (its != cases_.end()) its->second.runs[index].times = place;
}

void FinishedRuns::add_journal_line(const std::string& line, const LinePlace& place) {
  LinePlace part = place;
  for (const std::string_view text : split(line, separator)) {
    part.size = text.size();
    const std::string copy(text);
    const bool is_times = JsonRecord(copy, files_[place.file].string(), place.line).has("seconds");
    (this->*(is_times ? &FinishedRuns::add_times : &FinishedRuns::add_result))(copy, part);
    part.offset += text.size() + 1;
  }
}

void FinishedRuns::merge(const fs::path& directory) {
  FinishedRuns other(grid_);
  other.add(directory);
  LineReader reader(files_);
  LineReader other_reader(other.files_);
  for (auto& [id, its] : other.cases_) {
    Case& own = cases_.try_emplace(id, Case{its.sha256, std::vector<Run>(grid_.size())}).first->second;
    if (own.sha256 != its.sha256)
      throw InputError({directory.string(), 0, name_of(id)}, "another scene than in another part");
    for (std::size_t i = 0; i < its.runs.size(); ++i) {
      Run& theirs = its.runs[i];
      if (theirs.state == State::missing) continue;
      const bool is_final = own.runs[i].state == State::scored || own.runs[i].state == State::failed;
      const bool is_theirs_final = theirs.state == State::scored || theirs.state == State::failed;
      if (is_final && is_theirs_final &&
          reader.line(own.runs[i].result) != other_reader.line(theirs.result)) {
        const RunId run = grid_.run(i, id);
        throw InputError(
            {directory.string(), 0, name_of(id)},
            fmt::format("another result of {} at ratio {} than in another part", run.method, run.ratio));
      }
      if (is_final) continue;
      theirs.result.file += files_.size();
      theirs.times.file += files_.size();
      own.runs[i] = theirs;
    }
  }
  files_.insert(files_.end(), other.files_.begin(), other.files_.end());
}

bool FinishedRuns::has(const CaseId& id) const {
  const auto its = cases_.find(id);
  return its != cases_.end() && std::ranges::all_of(its->second.runs, [](const Run& run) {
           return run.state == State::scored || run.state == State::failed;
         });
}

bool FinishedRuns::is_failed(const RunId& run) const {
  const auto its = cases_.find(run.scene);
  return its != cases_.end() && its->second.runs[grid_.index_of(run)].state == State::failed;
}

void FinishedRuns::expect_cases_among(const std::vector<CaseId>& cases, const std::string& source) const {
  const std::set<CaseId> known(cases.begin(), cases.end());
  for (const auto& [id, its] : cases_) {
    if (!known.contains(id)) throw InputError({source, 0, name_of(id)}, "not a case of the recipe");
  }
}

void FinishedRuns::forget_changed(const Dataset& dataset, const ExperimentSettings& settings) {
  std::vector<CaseId> changed;
  for (const auto& [id, its] : cases_) {
    if (!dataset.catalogue.has(id)) {
      throw InputError({dataset.directory.string(), 0, name_of(id)},
                       "the dataset lacks this case, which the results have; use another directory for its "
                       "results");
    }
    if (its.sha256 != case_sha256(dataset, id) || has_other_labels(its, settings)) changed.push_back(id);
  }
  for (const CaseId& id : changed) cases_.erase(id);
}

bool FinishedRuns::has_other_labels(const Case& finished, const ExperimentSettings& settings) const {
  LineReader reader(files_);
  for (std::size_t i = 0; i < finished.runs.size(); ++i) {
    const auto* directory =
        std::get_if<LabelsDirectory>(&settings.methods[i / grid_.runs_of_a_method()].what);
    const State state = finished.runs[i].state;
    if (directory == nullptr || (state != State::scored && state != State::failed)) continue;
    const LinePlace& place = finished.runs[i].result;
    const RunResult result = run_result({reader.line(place), files_[place.file].string(), place.line});
    if (result.failure && result.failure->of == FailureOf::scene) continue;
    if (result.labels_sha256.value_or("") != labels_sha256(*directory, result.run)) return true;
  }
  return false;
}

std::size_t FinishedRuns::write(const fs::path& directory, const std::vector<CaseId>& order,
                                const fs::path& staging) const {
  LineReader reader(files_);
  StagedFile results(directory / results_name, staging);
  StagedFile times(directory / times_name, staging);
  ResultTables tables(directory, staging);
  for (std::size_t method = 0; method < grid_.methods.size(); ++method) {
    for (const CaseId& id : order) {
      const auto its = cases_.find(id);
      if (its == cases_.end()) continue;
      for (std::size_t i = 0; i < grid_.runs_of_a_method(); ++i) {
        const Run& run = its->second.runs[method * grid_.runs_of_a_method() + i];
        if (run.state == State::missing) continue;
        const std::string line = reader.line(run.result);
        results.append(line + '\n');
        tables.add({line, files_[run.result.file].string(), run.result.line});
        if (run.times.size > 0) times.append(reader.line(run.times) + '\n');
      }
    }
  }
  times.commit();
  results.commit();
  tables.commit();
  sync_directory(directory);
  return static_cast<std::size_t>(std::ranges::count_if(order, [&](const CaseId& id) { return has(id); }));
}

// ---- a results directory

void expect_free(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings) {
  if (fs::exists(directory / recipe_name))
    throw InputError({directory.string(), 0, ""}, "a dataset", "a directory for results");
  if (!fs::exists(directory / experiment_name)) return;
  expect_same_experiment(experiment_json(dataset, settings), read_experiment(directory), directory,
                         "; use another directory");
}

void claim(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings,
           const fs::path& staging) {
  expect_free(directory, dataset, settings);
  const fs::path file = directory / experiment_name;
  if (fs::exists(file)) return;
  write_staged(file, experiment_text(experiment_json(dataset, settings), place_of(dataset), 0), staging);
  sync_directory(directory);
}

void write_results(const fs::path& directory, const Dataset& dataset, const ExperimentSettings& settings,
                   const FinishedRuns& finished, const fs::path& staging) {
  const std::vector<CaseId> all = cases(dataset.recipe);
  StagedFile generation(directory / generation_name, staging);
  dataset.catalogue.for_each_times_line(all,
                                        [&](const std::string& line) { generation.append(line + '\n'); });
  generation.commit();
  const std::size_t count = finished.write(directory, all, staging);
  write_staged(directory / experiment_name,
               experiment_text(experiment_json(dataset, settings), place_of(dataset), count), staging);
  sync_directory(directory);
}

std::size_t merge_results(const std::vector<fs::path>& parts, const fs::path& directory) {
  if (parts.empty()) throw InputError({}, "no results to merge");
  if (fs::exists(directory / recipe_name))
    throw InputError({directory.string(), 0, ""}, "a dataset", "a directory for results");
  const JsonRecord first = read_experiment(parts.front());
  Json experiment = first.json();
  DatasetPlace place{experiment.value("dataset", Json()), experiment.value("dataset_digest", Json())};
  for (const char* key : {"dataset", "dataset_digest", "cases"}) experiment.erase(key);
  std::vector<fs::path> all = parts;
  if (fs::exists(directory / experiment_name)) all.insert(all.begin(), directory);
  for (const fs::path& part : all) {
    const JsonRecord found = read_experiment(part);
    expect_same_experiment(experiment, found, part, "");
    if (found.json().value("dataset", Json()) != place.directory) place.directory = Json();
    if (found.json().value("dataset_digest", Json()) != place.digest) place.digest = Json();
  }
  std::istringstream recipe_text(first.text("recipe"));
  const std::string source = (parts.front() / experiment_name).string() + ": recipe";
  const Recipe recipe = read_recipe(recipe_text, source);

  make_directories(directory);
  const Journal journal(directory);
  FinishedRuns merged(grid_of(first, recipe));
  for (const fs::path& part : all) merged.merge(part);
  const std::vector<CaseId> order = cases(recipe);
  merged.expect_cases_among(order, source);
  if (const auto generation =
          read_if_there(parts.front() / generation_name, std::numeric_limits<std::size_t>::max()))
    write_staged(directory / generation_name, *generation, journal.staging());
  const std::size_t count = merged.write(directory, order, journal.staging());
  write_staged(directory / experiment_name, experiment_text(experiment, place, count), journal.staging());
  sync_directory(directory);
  journal.clear();
  return count;
}

void for_each_result(const fs::path& directory,
                     const std::function<void(const RunResult&, const JsonRecord&)>& take) {
  const fs::path file = directory / results_name;
  for_each_whole_line(file, [&](const std::string& line, std::size_t number) {
    const JsonRecord record(line, file.string(), number);
    take(run_result(record), record);
  });
}

}  // namespace tanglebin
