// The measures besides micro-recall.
#include <fmt/format.h>

#include "tanglebin/report/html.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/summary.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

template <typename Measure>
std::string mean_share(const std::vector<RunScore>& runs, const Measure& measure) {
  return share_text(summarize(values(runs, measure)).mean);
}

std::string mean_rand_index(const std::vector<RunScore>& runs) {
  const auto several = chosen(runs, [](const RunScore& run) { return run.adjusted_rand_index.has_value(); });
  if (several.empty()) return "–";
  return mean_share(several, [](const RunScore& run) { return *run.adjusted_rand_index; });
}

std::string mean_error_mm(const std::vector<RunScore>& runs) {
  constexpr double millimetres = 1000;
  const auto found = chosen(runs, [](const RunScore& run) { return run.centre_line_error.has_value(); });
  if (found.empty()) return "–";
  const auto error = [](const RunScore& run) { return *run.centre_line_error; };
  return fmt::format("{:.2f}", millimetres * summarize(values(found, error)).mean);
}

/// "82.0 % of 50"
std::string percentage(std::size_t part, std::size_t whole) {
  if (whole == 0) return "–";
  return fmt::format("{:.1f} % of {}", 100.0 * static_cast<double>(part) / static_cast<double>(whole), whole);
}

std::size_t sum(const std::vector<RunScore>& runs, std::size_t RunScore::*count) {
  std::size_t total = 0;
  for (const RunScore& run : runs) total += run.*count;
  return total;
}

std::vector<std::string> row_of(int tubes, const std::vector<RunScore>& runs) {
  const std::size_t found = sum(runs, &RunScore::joins_found);
  return {std::to_string(tubes),
          std::to_string(runs.size()),
          std::to_string(count_failed(runs)),
          mean_share(runs, [](const RunScore& run) { return run.mean_iou; }),
          mean_share(runs, [](const RunScore& run) { return run.f1; }),
          mean_share(runs, [](const RunScore& run) { return run.panoptic_quality; }),
          mean_rand_index(runs),
          mean_error_mm(runs),
          percentage(found, sum(runs, &RunScore::true_joins)),
          percentage(found, sum(runs, &RunScore::joins_made))};
}

HtmlTable table_of(const std::vector<RunScore>& runs, const std::string& name, double ratio) {
  HtmlTable table{.caption_html = fmt::format("<b>{}</b> at ratio {}.", escaped(name), ratio_text(ratio)),
                  .columns = {},
                  .rows = {}};
  for (const char* heading : {"Tubes", "n", "failed", "mean IoU", "F1", "PQ", "ARI", "centre line, mm",
                              "joins found, of true", "joins true, of made"}) {
    table.columns.push_back({.heading = heading, .group = ""});
  }
  for (const int tubes : distinct(runs, [](const RunScore& run) { return tubes_of(run); })) {
    table.rows.push_back(
        row_of(tubes, chosen(runs, [&](const RunScore& run) { return tubes_of(run) == tubes; })));
  }
  return table;
}

}  // namespace

std::string other_measures(const Results& results) {
  constexpr const char* heading = "Other measures";
  if (results.scores.empty()) {
    return section_html("measures", heading,
                        paragraph("missing", "The results have no scores (<code>results.jsonl</code>)."));
  }
  const double ratio = shown_ratio(results.scores);
  const auto scores = chosen(results.scores, [&](const RunScore& run) { return run.run.ratio == ratio; });
  std::string content = paragraph(
      "note",
      "Means over the cases. IoU: intersection over union of a tube and its assigned label. "
      "F1 and PQ (panoptic quality): tubes detected at IoU above 0.5. ARI: adjusted "
      "Rand index, without scenes of one tube. Centre line: median distance of the modelled centre "
      "lines from the true ones, if a tube was found. Joins: between neighbouring pieces of a tube, "
      "hidden or not; how many of the true ones were found, and how many of those made "
      "are true. Tanglebin's <code>docs/metrics.md</code> defines each measure.");
  for (const RunGroup& group : groups_of(scores)) {
    content += html(table_of(chosen(scores, [&](const RunScore& run) { return is_of(run, group); }),
                             group_text(group, results), ratio));
  }
  return section_html("measures", heading, content);
}

}  // namespace tanglebin
