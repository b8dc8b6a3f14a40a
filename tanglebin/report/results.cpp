#include "tanglebin/report/results.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/experiment/run_failure.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/recipe/case_json.hpp"
#include "tanglebin/report/papers_recipe.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr double least_ratio = std::numeric_limits<double>::min();

double share_of(const JsonRecord& record, const std::string& field) {
  return record.number(field, 0, 1);
}

// ---- Files
// -------------------------------------------------------------------------------------------------

template <typename Take>
void for_each_record(const fs::path& file, const Take& take) {
  for_each_line(file, [&](const FileLine& line) { take(JsonRecord(line.text, file.string(), line.number)); });
}

template <typename Value>
std::vector<Value> read_records(const fs::path& file, Value (*read)(const JsonRecord&)) {
  std::vector<Value> values;
  for_each_record(file, [&](const JsonRecord& record) { values.push_back(read(record)); });
  return values;
}

std::vector<TimesRecord> read_generation(const fs::path& file) {
  std::vector<TimesRecord> times;
  for_each_line(file, [&](const FileLine& line) {
    times.push_back(times_record(line.text, file.string(), line.number));
  });
  return times;
}

std::map<std::string, double> numbers_by_name(const JsonRecord& record, const std::string& field) {
  std::map<std::string, double> numbers;
  if (!record.has(field)) return numbers;
  const JsonRecord inner = record.object(field);
  for (const std::string& name : inner.fields()) numbers[name] = inner.number(name);
  return numbers;
}

std::optional<Recipe> recipe_in(const JsonRecord& record, const fs::path& file) {
  if (!record.has("recipe")) return std::nullopt;
  std::istringstream text(record.text("recipe"));
  return read_recipe(text, file.string() + ": recipe");
}

void add_other_methods(const JsonRecord& others, ExperimentRecord& experiment) {
  for (const std::string& name : others.fields()) {
    const JsonRecord other = others.object(name);
    auto& [option, value] = experiment.options_of_methods[name];
    option = other.has("labels") ? "--labels" : "--method";
    if (other.has("labels")) {
      value = other.text("labels");
    } else if (other.has("profile")) {
      value = other.text("method") + ":" + other.text("profile");
    } else {
      value = other.text("command");
      experiment.time_limit = other.number("time_limit", 0);
      experiment.memory_limit = other.number_or_null("memory_limit", 0, infinity);
    }
  }
}

ExperimentRecord read_experiment(const fs::path& file) {
  const std::optional<std::string> text = read_if_there(file);
  if (!text) {
    throw InputError({file.string(), 0, ""}, "is missing: not a results directory of `tanglebin experiment`");
  }
  const JsonRecord record(*text, file.string(), 0);
  ExperimentRecord experiment{.version = record.text("version"),
                              .dataset_seed = record.whole_number("dataset_seed"),
                              .methods = record.texts("methods"),
                              .ratios = record.numbers("ratios", least_ratio, 1),
                              .seed = record.whole_number("seed"),
                              .cases = record.whole_number("cases"),
                              .recipe_sha256 = record.text("recipe_sha256"),
                              .recipe = recipe_in(record, file),
                              .dataset = record.text_if_there("dataset").value_or(""),
                              .dataset_digest = record.text_if_there("dataset_digest").value_or(""),
                              .parameters = numbers_by_name(record, "parameters"),
                              .has_scene_file = !record.text_if_there("scene").value_or("").empty()};
  if (record.has("other_methods")) add_other_methods(record.object("other_methods"), experiment);
  return experiment;
}

// ---- Records
// -------------------------------------------------------------------------------------------------

RunKey run_of(const JsonRecord& record) {
  return {.id = id_of(record),
          .method = record.text("method"),
          .ratio = record.number("ratio", least_ratio, 1),
          .scanner = record.text_if_there("scanner").value_or("")};
}

RunScore score_of(const JsonRecord& record) {
  RunScore score{.run = run_of(record), .drawn = numbers_by_name(record, "drawn")};
  if (const auto failure = failure_in(record)) {
    score.failure = failure->reason;
    if (score.run.id.tubes == 1) score.adjusted_rand_index.reset();
    return score;
  }
  score.micro_recall = share_of(record, "micro_recall");
  score.mean_iou = share_of(record, "mean_iou");
  score.f1 = share_of(record, "f1");
  score.panoptic_quality = share_of(record, "panoptic_quality");
  score.adjusted_rand_index = record.number_or_null("adjusted_rand_index", -1, 1);
  if (record.has("unmixed_recall")) score.unmixed_recall = record.number_or_null("unmixed_recall", 0, 1);
  if (!record.has("tubes_found")) return score;  // a method that gives labels only
  score.centre_line_error = record.number_or_null("centre_line_error", 0, infinity);
  score.true_joins = record.whole_number("true_joins");
  score.joins_found = record.whole_number("joins_found");
  score.joins_made = record.whole_number("joins_made");
  return score;
}

bool is_unscored(const JsonRecord& record) {
  const auto failure = failure_in(record);
  return failure && failure->of == FailureOf::scene;
}

// Reads results.jsonl.
void add_scores(const fs::path& file, Results& results) {
  for_each_record(file, [&](const JsonRecord& record) {
    if (is_unscored(record)) {
      results.unscored.push_back(run_of(record));
    } else {
      results.scores.push_back(score_of(record));
    }
  });
}

RunTime time_of(const JsonRecord& record) {
  return {.run = run_of(record), .seconds = record.number("seconds", 0, infinity)};
}

/// The path of a file, which must be inside the results directory.
std::string path_inside(const JsonRecord& record, const std::string& field) {
  std::string text = record.text(field);
  const fs::path path(text);
  if (path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end())
    record.fail(field, excerpt(text), "a path below the results directory");
  return text;
}

CasePictures pictures_of(const JsonRecord& record) {
  CasePictures pictures{.run = run_of(record),
                        .rank = record.text("rank"),
                        .micro_recall = share_of(record, "micro_recall"),
                        .truth_file = path_inside(record, "truth"),
                        .truth_png = {},
                        .labels_file = path_inside(record, "labels"),
                        .labels_png = {}};
  const std::vector<std::string> ranks = {"best", "median", "worst"};
  if (std::ranges::find(ranks, pictures.rank) == ranks.end()) {
    record.fail("rank", excerpt(pictures.rank), "best, median or worst");
  }
  return pictures;
}

/// The bytes of a picture; empty if it is missing.
std::string read_png(const fs::path& directory, const std::string& name) {
  constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
  const fs::path file = directory / name;
  std::optional<std::string> bytes = read_if_there(file);
  if (!bytes) return {};
  if (!bytes->starts_with(signature))
    throw InputError({file.string(), 0, ""}, excerpt(*bytes), "a PNG picture");
  return std::move(*bytes);
}

/// A line of scenes.jsonl, as it is. What it says is for the page's script; a line of anything else is an
/// error here.
std::string scene_of(const JsonRecord& record) {
  record.text("name");
  record.texts("palette");
  record.object("points").whole_number("count");
  for (const JsonRecord& labelling : record.objects("labellings")) labelling.text("name");
  return json_text(record.json());
}

}  // namespace

Results read_results_directory(const fs::path& directory) {
  Results results{.directory = directory.string(),
                  .experiment = read_experiment(directory / "experiment.json"),
                  .is_papers = false,
                  .scores = {},
                  .unscored = {},
                  .times = read_records(directory / "times.jsonl", time_of),
                  .generation = read_generation(directory / "generation.jsonl"),
                  .pictures = read_records(directory / "pictures.jsonl", pictures_of),
                  .scenes = read_records(directory / "scenes.jsonl", scene_of),
                  .unfinished = fs::exists(directory / "journal.jsonl")};
  results.is_papers = is_papers_recipe(results.experiment.recipe_sha256, results.experiment.dataset_seed);
  add_scores(directory / "results.jsonl", results);
  for (CasePictures& pictures : results.pictures) {
    pictures.truth_png = read_png(directory, pictures.truth_file);
    pictures.labels_png = read_png(directory, pictures.labels_file);
  }
  return results;
}

}  // namespace tanglebin
