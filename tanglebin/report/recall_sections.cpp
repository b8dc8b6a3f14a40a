// Figures 8 and 9: micro-recall.
#include <fmt/format.h>

#include "tanglebin/report/html.hpp"
#include "tanglebin/report/plot.hpp"
#include "tanglebin/report/published_figures.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/summary.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

/// Micro-recall at one x.
struct RecallPoint {
  double x;
  Summary recall;
  std::size_t failed;  ///< runs
  std::optional<double> published;
};

/// A line of a figure.
struct RecallLine {
  std::string name;
  std::vector<RecallPoint> points;
};

/// The horizontal axis.
struct RecallAxis {
  std::string label;
  double (*x)(const RunScore&);
  std::optional<double> (*published)(const std::string& set, double x);
};

const RecallAxis tubes_axis = {
    .label = "Tubes",
    .x = [](const RunScore& score) { return static_cast<double>(tubes_of(score)); },
    .published = [](const std::string& set,
                    double x) { return published_micro_recall(set, static_cast<int>(x)); }};

const RecallAxis ratio_axis = {
    .label = "Ratio",
    .x = [](const RunScore& score) { return score.run.ratio; },
    .published = [](const std::string&, double) { return std::optional<double>(); }};

/// The paper's number, if the recipe is the paper's.
std::optional<double> published(const Results& results, const RecallAxis& axis, const std::string& set,
                                double x) {
  return results.is_papers ? axis.published(set, x) : std::nullopt;
}

RecallLine line_of(const Results& results, const std::vector<RunScore>& scores, const RunGroup& group,
                   const RecallAxis& axis) {
  const auto runs = chosen(scores, [&](const RunScore& score) { return is_of(score, group); });
  RecallLine line{.name = group_text(group, results), .points = {}};
  for (const double x : distinct(runs, axis.x)) {
    const auto here = chosen(runs, [&](const RunScore& score) { return axis.x(score) == x; });
    const auto recall = values(here, [](const RunScore& score) { return score.micro_recall; });
    line.points.push_back({.x = x,
                           .recall = summarize(recall),
                           .failed = count_failed(here),
                           .published = published(results, axis, group.set, x)});
  }
  return line;
}

std::vector<RecallLine> lines_of(const Results& results, const std::vector<RunScore>& scores,
                                 const RecallAxis& axis) {
  std::vector<RecallLine> lines;
  for (const RunGroup& group : groups_of(scores)) {
    lines.push_back(line_of(results, scores, group, axis));
  }
  return lines;
}

bool has_published(const RecallLine& line) {
  return std::ranges::any_of(line.points,
                             [](const RecallPoint& point) { return point.published.has_value(); });
}

// ---- Plot
// ----------------------------------------------------------------------------------------------------

PlotSeries measured_series(const RecallLine& line) {
  PlotSeries series{.name = line.name, .points = {}};
  for (const auto& [x, recall, failed, published] : line.points) {
    series.points.push_back(
        {.x = x, .y = recall.mean, .low = recall.first_quartile, .high = recall.third_quartile});
  }
  return series;
}

/// The paper's numbers, shared by all methods.
std::vector<PlotSeries> published_series(const Results& results, const std::vector<RunScore>& scores,
                                         const RecallAxis& axis) {
  std::vector<PlotSeries> result;
  for (const std::string& set : distinct(scores, [](const RunScore& score) { return score.run.id.set; })) {
    PlotSeries series{.name = fmt::format("Set {}, published", set), .points = {}, .is_published = true};
    const auto of_set = chosen(scores, [&](const RunScore& score) { return score.run.id.set == set; });
    for (const double x : distinct(of_set, axis.x)) {
      if (const auto y = published(results, axis, set, x))
        series.points.push_back({.x = x, .y = *y, .low = *y, .high = *y});
    }
    if (!series.points.empty()) result.push_back(series);
  }
  return result;
}

/// A line in words, for readers who cannot see it, such as "Set A: 0.950 at 1, 0.870 at 20".
std::string in_words(const RecallLine& line) {
  const RecallPoint& first = line.points.front();
  const RecallPoint& last = line.points.back();
  return fmt::format("{}: {:.3f} at {:g}, {:.3f} at {:g}", line.name, first.recall.mean, first.x,
                     last.recall.mean, last.x);
}

std::string plot_of(const Results& results, const std::vector<RunScore>& scores,
                    const std::vector<RecallLine>& lines, const RecallAxis& axis,
                    const std::string& x_label) {
  Plot plot{.text = "Mean micro-recall by " + x_label + ".",
            .x_label = x_label,
            .y_label = "micro-recall",
            .y_greatest = 1,
            .series = {}};
  for (const RecallLine& line : lines) {
    plot.text += " " + in_words(line) + ".";
    plot.series.push_back(measured_series(line));
  }
  for (const PlotSeries& series : published_series(results, scores, axis)) plot.series.push_back(series);
  return html(plot);
}

// ---- Tables
// --------------------------------------------------------------------------------------------------

/// Enough for one plot's colours, or one part for each set.
std::vector<std::vector<RunScore>> parts_to_plot(const std::vector<RunScore>& scores) {
  constexpr std::size_t most_lines = 6;
  if (groups_of(scores).size() <= most_lines) return {scores};
  std::vector<std::vector<RunScore>> parts;
  const auto set_of = [](const RunScore& score) { return score.run.id.set; };
  for (const std::string& set : distinct(scores, set_of))
    parts.push_back(chosen(scores, [&](const RunScore& score) { return set_of(score) == set; }));
  return parts;
}

/// "Figure 8" where the figure stands beside the paper's.
std::string figure_name(const Results& results, int number) {
  return results.is_papers ? fmt::format("Figure {}", number) : "";
}

/// "<b>Figure 8.</b> "
std::string leading(const std::string& figure) {
  return figure.empty() ? "" : fmt::format("<b>{}.</b> ", figure);
}

HtmlTable table_of(const RecallLine& line, const RecallAxis& axis, const std::string& figure) {
  HtmlTable table{.caption_html = fmt::format("<b>{}{}{}.</b> Micro-recall of the cases.", figure,
                                              figure.empty() ? "" : ", ", escaped(line.name)),
                  .columns = {{.heading = axis.label, .group = ""}},
                  .rows = {}};
  for (const char* heading : {"n", "failed", "mean", "SD", "min", "Q1", "median", "Q3", "max"}) {
    table.columns.push_back({.heading = heading, .group = ""});
  }
  if (has_published(line)) {
    table.columns.push_back({.heading = "published", .group = "", .is_published = true});
  }
  for (const auto& [x, recall, failed, published] : line.points) {
    table.rows.push_back(
        {ratio_text(x), std::to_string(recall.count), std::to_string(failed), share_text(recall.mean),
         share_text(recall.standard_deviation), share_text(recall.least), share_text(recall.first_quartile),
         share_text(recall.median), share_text(recall.third_quartile), share_text(recall.greatest)});
    if (has_published(line)) table.rows.back().push_back(published ? "≈ " + share_text(published) : "–");
  }
  return table;
}

std::string tables_of(const std::vector<RecallLine>& lines, const RecallAxis& axis,
                      const std::string& figure) {
  std::string content = "<div class=\"side-by-side\">\n";
  for (const RecallLine& line : lines) content += html(table_of(line, axis, figure));
  return content + "</div>\n";
}

// ---- Words
// ---------------------------------------------------------------------------------------------------

constexpr const char* reading_aid =
    "Points: means. Bars: first to third quartile (the middle half of the cases). The vertical axis may not "
    "start at 0.";

constexpr const char* no_scores =
    "The results have no scores (<code>results.jsonl</code>), so there is nothing to plot.";

/// The plots of a figure, with one caption.
std::string figure_of(const Results& results, const std::vector<RunScore>& scores, const RecallAxis& axis,
                      const std::string& x_label, const std::string& caption_html) {
  const std::vector<std::vector<RunScore>> parts = parts_to_plot(scores);
  std::string plots;
  for (const std::vector<RunScore>& part : parts)
    plots += fmt::format("<div>\n{}</div>\n",
                         plot_of(results, part, lines_of(results, part, axis), axis, x_label));
  if (parts.size() > 1) plots = fmt::format("<div class=\"side-by-side\">\n{}</div>\n", plots);
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption></figure>\n", plots, caption_html);
}

std::string figure_8_note(const std::vector<RecallLine>& lines) {
  if (std::ranges::none_of(lines, has_published)) return {};
  return paragraph(
      "note",
      "Published: approximate values for set B at ratio 0.3 from the paper's text: 0.867 for one tube, 3.9 % "
      "more than that for two and 4.1 % less for ten. The paper prints no other numbers of its Figure 8.");
}

}  // namespace

std::string recall_by_tubes(const Results& results) {
  constexpr const char* heading = "Micro-recall by number of tubes";
  if (results.scores.empty()) return section_html("figure-8", heading, paragraph("missing", no_scores));
  const double ratio = shown_ratio(results.scores);
  const auto scores = chosen(results.scores, [&](const RunScore& score) { return score.run.ratio == ratio; });
  const auto lines = lines_of(results, scores, tubes_axis);
  std::string content;
  const std::string figure = figure_name(results, 8);
  if (results.is_papers && std::abs(ratio - figure_8_ratio) > 1e-9) {
    content += paragraph(
        "note", fmt::format("The ratio of the paper's Figure 8, {}, was not run; this shows the nearest, {}.",
                            figure_8_ratio, ratio_text(ratio)));
  }
  content += figure_of(
      results, scores, tubes_axis, "number of tubes",
      fmt::format("{}Micro-recall by number of tubes at downsampling ratio {}. {}{}", leading(figure),
                  ratio_text(ratio), reading_aid,
                  std::ranges::any_of(lines, has_published) ? " Diamonds: from the paper's text." : ""));
  return section_html("figure-8", heading,
                      content + figure_8_note(lines) + tables_of(lines, tubes_axis, figure));
}

std::string recall_by_ratio(const Results& results) {
  constexpr const char* heading = "Micro-recall by downsampling ratio";
  if (results.scores.empty()) return section_html("figure-9", heading, paragraph("missing", no_scores));
  const int tubes = shown_tubes(results.scores);
  const auto scores = chosen(results.scores, [&](const RunScore& score) { return tubes_of(score) == tubes; });
  const auto lines = lines_of(results, scores, ratio_axis);
  std::string content;
  const std::string figure = figure_name(results, 9);
  if (results.is_papers && tubes != figure_9_tubes) {
    content += paragraph(
        "note", fmt::format("The number of tubes of the paper's Figure 9, {}, was not run; this shows the "
                            "nearest, {}.",
                            figure_9_tubes, tubes));
  }
  content +=
      figure_of(results, scores, ratio_axis, "downsampling ratio",
                fmt::format("{}Micro-recall by downsampling ratio in bins with {}. {}{}", leading(figure),
                            counted(static_cast<std::size_t>(tubes), "tube"), reading_aid,
                            results.is_papers ? " The paper prints no numbers of its Figure 9." : ""));
  return section_html("figure-9", heading, content + tables_of(lines, ratio_axis, figure));
}

}  // namespace tanglebin
