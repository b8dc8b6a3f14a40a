// Which method did best: in all scenes, and by set, scanner and number of tubes.
#include <fmt/format.h>

#include <functional>
#include <map>

#include "tanglebin/report/html.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/summary.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

/// A method's runs at the ratio that is shown.
struct Standing {
  std::string method;
  std::vector<RunScore> runs;
  Summary recall;
  std::optional<double> seconds;  ///< mean; none if its labels existed
};

/// Over scenes, each with the mean over its scanners.
Summary recall_of(const std::vector<RunScore>& runs) {
  std::map<CaseId, std::vector<double>> scenes;
  for (const RunScore& run : runs) scenes[run.run.id].push_back(run.micro_recall);
  std::vector<double> means;
  means.reserve(scenes.size());
  for (const auto& [scene, recalls] : scenes) means.push_back(summarize(recalls).mean);
  return summarize(std::move(means));
}

std::optional<double> mean_seconds(const Results& results, const std::string& method, double ratio) {
  const auto times = chosen(results.times, [&](const RunTime& time) {
    return time.run.method == method && time.run.ratio == ratio;
  });
  if (times.empty()) return std::nullopt;
  return summarize(values(times, [](const RunTime& time) { return time.seconds; })).mean;
}

/// The best first.
std::vector<Standing> standings_of(const Results& results, const std::vector<RunScore>& scores,
                                   double ratio) {
  std::vector<Standing> standings;
  for (const std::string& method : distinct(scores, [](const RunScore& run) { return run.run.method; })) {
    auto runs = chosen(scores, [&](const RunScore& run) { return run.run.method == method; });
    const Summary recall = recall_of(runs);
    standings.push_back({method, std::move(runs), recall, mean_seconds(results, method, ratio)});
  }
  std::ranges::stable_sort(standings, std::greater<>(),
                           [](const Standing& standing) { return standing.recall.mean; });
  return standings;
}

std::vector<HtmlColumn> columns_of(const std::vector<std::string>& headings) {
  std::vector<HtmlColumn> columns;
  columns.reserve(headings.size());
  for (const std::string& heading : headings) columns.push_back({.heading = heading, .group = ""});
  return columns;
}

HtmlTable overall(const std::vector<Standing>& standings, double ratio) {
  HtmlTable table{
      .caption_html = fmt::format("<b>Leaderboard</b> at downsampling ratio {}.", ratio_text(ratio)),
      .columns = columns_of({"Method", "micro-recall", "scenes", "runs", "failed", "seconds"}),
      .rows = {}};
  for (const Standing& standing : standings) {
    table.rows.push_back({standing.method, mean_text(standing.recall), std::to_string(standing.recall.count),
                          std::to_string(standing.runs.size()), std::to_string(count_failed(standing.runs)),
                          seconds_text(standing.seconds, 3)});
  }
  return table;
}

/// The micro-recall of each method, a column for each value of group_of(run). Empty if there is only one.
template <typename GroupOf>
std::string table_by(const std::vector<Standing>& standings, const std::vector<RunScore>& scores,
                     const std::string& caption, const GroupOf& group_of) {
  const auto groups = distinct(scores, group_of);
  if (groups.size() < 2) return "";
  HtmlTable table{.caption_html = caption, .columns = columns_of({"Method"}), .rows = {}};
  for (const auto& group : groups)
    table.columns.push_back({.heading = fmt::format("{}", group), .group = ""});
  for (const Standing& standing : standings) {
    std::vector<std::string> row = {standing.method};
    for (const auto& group : groups) {
      const auto runs = chosen(standing.runs, [&](const RunScore& run) { return group_of(run) == group; });
      row.push_back(runs.empty() ? "–" : mean_text(recall_of(runs)));
    }
    table.rows.push_back(row);
  }
  return html(table);
}

}  // namespace

std::string leaderboard(const Results& results) {
  constexpr const char* heading = "Leaderboard";
  if (results.scores.empty()) {
    return section_html("leaderboard", heading,
                        paragraph("missing", "The results have no scores (<code>results.jsonl</code>)."));
  }
  const double ratio = shown_ratio(results.scores);
  const auto scores = chosen(results.scores, [&](const RunScore& run) { return run.run.ratio == ratio; });
  const std::vector<Standing> standings = standings_of(results, scores, ratio);
  const std::string note = paragraph(
      "note",
      "Mean micro-recall over scenes, each of which counts once, with the mean over its scanners. ± is half "
      "the 95 % confidence interval of the mean. A failed run counts as one that found nothing. Seconds: "
      "mean time of a run.");
  return section_html(
      "leaderboard", heading,
      note + html(overall(standings, ratio)) +
          table_by(standings, scores, "<b>By set.</b>", [](const RunScore& run) { return run.run.id.set; }) +
          table_by(standings, scores, "<b>By scanner.</b>",
                   [](const RunScore& run) { return run.run.scanner; }) +
          table_by(standings, scores, "<b>By number of tubes.</b>",
                   [](const RunScore& run) { return tubes_of(run); }));
}

}  // namespace tanglebin
