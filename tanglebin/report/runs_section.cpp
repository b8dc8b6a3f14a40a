// Every run, to sort, filter and plot.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/script.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

auto key_of(const RunKey& run) {
  return std::tuple(run.id.set, run.id.tubes, run.id.number, run.scanner, run.method, run.ratio);
}

/// What a number drawn for a run's case is called, whatever set or scanner it is of: "tube.radius" of
/// "set[2].tube.radius", "scanner.sigma" of "scanner[1].sigma". Empty for a number of another scanner.
std::string variable_of(const std::string& path, const RunKey& run, const std::optional<Recipe>& recipe) {
  const std::size_t bracket = path.find("].");
  if (path.starts_with("set[") && bracket != std::string::npos) return path.substr(bracket + 2);
  if (!path.starts_with("scanner[") || bracket == std::string::npos || !recipe) return path;
  const std::vector<Scanner> all = scanners(*recipe);
  const std::size_t own =
      static_cast<std::size_t>(std::ranges::find(all, run.scanner, &Scanner::name) - all.begin());
  return path.starts_with(fmt::format("scanner[{}].", own)) ? "scanner." + path.substr(bracket + 2) : "";
}

/// The numbers that were drawn for the runs' cases, as columns.
Json drawn_columns_of(const Results& results) {
  std::map<std::string, std::vector<std::optional<double>>> columns;
  for (std::size_t i = 0; i < results.scores.size(); ++i) {
    const RunScore& score = results.scores[i];
    for (const auto& [path, value] : score.drawn) {
      const std::string name = variable_of(path, score.run, results.experiment.recipe);
      if (name.empty()) continue;
      auto& column = columns[name];
      column.resize(results.scores.size());
      column[i] = value;
    }
  }
  Json json = Json::object();
  for (const auto& [name, column] : columns) {
    for (const std::optional<double>& value : column) json[name].push_back(number_or_null(value));
  }
  return json;
}

/// The runs as columns: a list of values for each name, with null where a run has none.
Json columns_of(const Results& results) {
  std::map<decltype(key_of({})), double> seconds;
  for (const RunTime& time : results.times) seconds[key_of(time.run)] = time.seconds;
  Json columns;
  for (const RunScore& score : results.scores) {
    const RunKey& run = score.run;
    columns["set"].push_back(run.id.set);
    columns["tubes"].push_back(run.id.tubes);
    columns["case"].push_back(run.id.number);
    columns["scanner"].push_back(run.scanner);
    columns["method"].push_back(run.method);
    columns["ratio"].push_back(run.ratio);
    columns["micro_recall"].push_back(score.micro_recall);
    columns["mean_iou"].push_back(score.mean_iou);
    columns["f1"].push_back(score.f1);
    columns["panoptic_quality"].push_back(score.panoptic_quality);
    columns["adjusted_rand_index"].push_back(number_or_null(score.adjusted_rand_index));
    columns["unmixed_recall"].push_back(number_or_null(score.unmixed_recall));
    columns["centre_line_error"].push_back(number_or_null(score.centre_line_error));
    columns["joins_missed"].push_back(score.true_joins - score.joins_found);
    columns["joins_wrong"].push_back(score.joins_made - score.joins_found);
    const auto time = seconds.find(key_of(run));
    columns["seconds"].push_back(time == seconds.end() ? Json() : Json(time->second));
    columns["failed"].push_back(!score.failure.empty());
  }
  columns["drawn"] = drawn_columns_of(results);
  return columns;
}

}  // namespace

std::string all_runs(const Results& results) {
  constexpr const char* heading = "All runs";
  if (results.scores.empty()) {
    return section_html("runs", heading,
                        paragraph("missing", "The results have no scores (<code>results.jsonl</code>)."));
  }
  const std::string note =
      paragraph("note",
                "Each row is a run: a case, a method and a downsampling ratio, and a scanner if there are "
                "several. Columns "
                "after the seconds, if any, are numbers that the recipe draws for each case. Choose what to "
                "plot, choose which runs "
                "count, and sort by any column. A failed run counts as one that found nothing.");
  const std::string without =
      paragraph("note", "This needs JavaScript. <code>results.jsonl</code> has the same numbers.");
  return section_html("runs", heading,
                      note + fmt::format("<div class=\"runs\">{}<div class=\"instead\">{}</div></div>\n",
                                         json_script(json_text(columns_of(results))), without));
}

}  // namespace tanglebin
