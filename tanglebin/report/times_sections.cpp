// Tables 1 and 2: times.
#include <fmt/format.h>

#include "tanglebin/report/html.hpp"
#include "tanglebin/report/published_figures.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/summary.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

/// Three, because a case with one tube takes a few hundredths of a second.
constexpr int decimals = 3;

double generation_seconds(const TimesRecord& record) {
  const StageTimes& times = record.times;
  return times.generate + times.settle + times.scan + times.write;
}

std::string note_on_times(const Results& results) {
  std::string note = "All times are mean wall-clock times.";
  if (results.is_papers) {
    note += fmt::format(
        " The published times are from other hardware ({}), so the ratios compare machines as well as "
        "programs.",
        escaped(published_machine));
  }
  return paragraph("note", note);
}

/// "<b>Table 1.</b> " where the table stands beside the paper's.
std::string table_name(const Results& results, int number) {
  return results.is_papers ? fmt::format("<b>Table {}.</b> ", number) : "";
}

// ---- Table 1
// -------------------------------------------------------------------------------------------------

std::vector<std::string> sets_of(const std::vector<TimesRecord>& records) {
  return distinct(records, [](const TimesRecord& record) { return record.id.set; });
}

bool is_in_table_1(const Results& results, const std::string& set) {
  return results.is_papers && published_generation_time(set, 1).has_value();
}

std::vector<HtmlColumn> table_1_columns(const Results& results, const std::vector<std::string>& sets) {
  std::vector<HtmlColumn> columns = {{.heading = "Tubes", .group = ""}};
  for (const std::string& set : sets) {
    const std::string group = "Set " + set;
    columns.push_back({.heading = "cases", .group = group});
    columns.push_back({.heading = "time, s", .group = group});
    if (!is_in_table_1(results, set)) continue;
    columns.push_back({.heading = "published, s", .group = group, .is_published = true});
    columns.push_back({.heading = "ratio", .group = group});
  }
  return columns;
}

void add_table_1_cells(std::vector<std::string>& row, const std::vector<TimesRecord>& cases,
                       const std::string& set, int tubes, bool is_published) {
  const std::optional<double> published = published_generation_time(set, tubes);
  std::optional<double> mean;
  if (!cases.empty()) mean = summarize(values(cases, generation_seconds)).mean;
  row.push_back(std::to_string(cases.size()));
  row.push_back(seconds_text(mean, decimals));
  if (!is_published) return;
  row.push_back(seconds_text(published));
  row.push_back(mean && published ? fmt::format("{:.3f}", *mean / *published) : "–");
}

HtmlTable table_1(const Results& results) {
  const std::vector<TimesRecord>& records = results.generation;
  const std::vector<std::string> sets = sets_of(records);
  HtmlTable table{.caption_html = table_name(results, 1) + "Mean time to generate a case" +
                                  (results.is_papers ? ", beside the paper's Table 1. Ratio: time divided by "
                                                       "published time."
                                                     : "."),
                  .columns = table_1_columns(results, sets),
                  .rows = {}};
  for (const int tubes : distinct(records, [](const TimesRecord& record) { return tubes_of(record); })) {
    std::vector<std::string> row = {std::to_string(tubes)};
    for (const std::string& set : sets) {
      const auto is_wanted = [&](const TimesRecord& record) {
        return record.id.set == set && record.id.tubes == tubes;
      };
      add_table_1_cells(row, chosen(records, is_wanted), set, tubes, is_in_table_1(results, set));
    }
    table.rows.push_back(row);
  }
  return table;
}

// ---- Table 2
// -------------------------------------------------------------------------------------------------

bool is_in_table_2(const Results& results, const std::string& set, int tubes) {
  return results.is_papers && published_modelling_time(set, tubes, 1).has_value();
}

std::vector<HtmlColumn> table_2_columns(const Results& results, const std::string& set,
                                        const std::vector<int>& tube_counts) {
  std::vector<HtmlColumn> columns = {{.heading = "Ratio", .group = ""}};
  for (const int tubes : tube_counts) {
    const std::string number = std::to_string(tubes);
    if (!is_in_table_2(results, set, tubes)) {
      columns.push_back({.heading = number, .group = ""});
      continue;
    }
    columns.push_back({.heading = "time", .group = number});
    columns.push_back({.heading = "publ.", .group = number, .is_published = true});
  }
  return columns;
}

std::string mean_time(const std::vector<RunTime>& times) {
  if (times.empty()) return seconds_text(std::nullopt);
  return seconds_text(summarize(values(times, [](const RunTime& time) { return time.seconds; })).mean,
                      decimals);
}

HtmlTable table_2(const Results& results, const RunGroup& group) {
  const std::vector<RunTime> times =
      chosen(results.times, [&](const RunTime& time) { return is_of(time, group); });
  const std::vector<int> tube_counts = distinct(times, [](const RunTime& time) { return tubes_of(time); });
  HtmlTable table{.caption_html = fmt::format(
                      "<b>{}{}.</b> Mean time to model the tubes of a case, in seconds. Rows: downsampling "
                      "ratio. Columns: number of tubes{}.",
                      results.is_papers ? "Table 2, " : "", escaped(group_text(group, results)),
                      results.is_papers && group.set == "A" ? ". Publ.: the paper's Table 2" : ""),
                  .columns = table_2_columns(results, group.set, tube_counts),
                  .rows = {}};
  for (const double ratio : distinct(times, [](const RunTime& time) { return time.run.ratio; })) {
    std::vector<std::string> row = {ratio_text(ratio)};
    for (const int tubes : tube_counts) {
      row.push_back(mean_time(chosen(
          times, [&](const RunTime& time) { return time.run.ratio == ratio && tubes_of(time) == tubes; })));
      if (is_in_table_2(results, group.set, tubes)) {
        row.push_back(seconds_text(published_modelling_time(group.set, tubes, ratio)));
      }
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

std::string generation_times(const Results& results) {
  std::string content;
  if (results.generation.empty()) {
    content = paragraph("missing", "The results have no generation times (<code>generation.jsonl</code>).");
  } else {
    content =
        html(table_1(results)) + note_on_times(results) +
        paragraph("note", std::string("A case's time includes rejected attempts.") +
                              (results.is_papers ? " The paper's simulation ran at three times real time; "
                                                   "Tanglebin's runs as fast as possible."
                                                 : ""));
  }
  return section_html("table-1", "Generation time", content);
}

std::string modelling_times(const Results& results) {
  std::string content;
  for (const RunGroup& group : groups_of(results.times)) content += html(table_2(results, group));
  if (content.empty()) {
    content = paragraph("missing", "The results have no modelling times (<code>times.jsonl</code>).");
  } else {
    content += note_on_times(results);
  }
  return section_html("table-2", "Modelling time", content);
}

}  // namespace tanglebin
