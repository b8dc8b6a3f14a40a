// The beginning of the report: what was run, and the headline results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "tanglebin/base/text.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/published_figures.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/summary.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

std::string ratios_text(const std::vector<double>& ratios) {
  std::vector<std::string> words;
  std::ranges::transform(ratios, std::back_inserter(words), ratio_text);
  return fmt::format("{}", fmt::join(words, ", "));
}

// ---- What was run
// --------------------------------------------------------------------------------------------

/// "2 of 9 cases", or "9 cases" if these are all that the recipe has
std::string cases_text(std::size_t count, const std::optional<Recipe>& recipe, const std::string& set) {
  const auto all =
      recipe ? static_cast<std::size_t>(std::ranges::count(cases(*recipe), set, &CaseId::set)) : 0;
  return count < all ? fmt::format("{} of {}", count, counted(all, "case")) : counted(count, "case");
}

/// "320 cases of set A (1 to 20 tubes)"
std::string set_text(const Results& results, const std::string& set) {
  const auto runs = chosen(results.scores, [&](const RunScore& score) { return score.run.id.set == set; });
  const auto scored = distinct(runs, [](const RunScore& score) { return score.run.id; });
  const auto tubes = distinct(runs, [](const RunScore& score) { return tubes_of(score); });
  const std::string numbers = tubes.size() == 1 ? "" : fmt::format("{} to ", tubes.front());
  return fmt::format("{} of set {} ({}{})", cases_text(scored.size(), results.experiment.recipe, set), set,
                     numbers, counted(static_cast<std::size_t>(tubes.back()), "tube"));
}

std::string dataset_text(const Results& results) {
  std::vector<std::string> sets;
  for (const std::string& set :
       distinct(results.scores, [](const RunScore& score) { return score.run.id.set; })) {
    sets.push_back(set_text(results, set));
  }
  return sets.empty() ? "no scored cases" : joined(sets);
}

std::string fact(const std::string& name, const std::string& value_html) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value_html);
}

std::string facts(const Results& results) {
  const ExperimentRecord& experiment = results.experiment;
  const std::size_t failed = count_failed(results.scores);
  return "<dl>\n" +
         fact("Dataset",
              fmt::format("{}; seed {}", escaped(dataset_text(results)), experiment.dataset_seed)) +
         (experiment.dataset_digest.empty()
              ? ""
              : fact("Digest", fmt::format("<code>{}</code>", escaped(experiment.dataset_digest)))) +
         fact("Recipe", fmt::format("SHA-256 <code>{}</code>", escaped(experiment.recipe_sha256))) +
         fact("Methods", escaped(joined(experiment.methods))) +
         fact("Downsampling ratios", ratios_text(experiment.ratios)) +
         fact("Runs", fmt::format("{} scored, {} failed; seed {}", results.scores.size() - failed, failed,
                                  experiment.seed)) +
         fact("Version", "Tanglebin " + escaped(experiment.version)) + "</dl>\n";
}

// ---- Headline
// ----------------------------------------------------------------------------------------------

/// "0.912 ± 0.010 (set A) and 0.889 ± 0.013 (set B)"
std::string recalls_of(const std::vector<RunScore>& scores, const std::string& method) {
  std::vector<std::string> words;
  for (const RunGroup& group : groups_of(scores)) {
    if (group.method != method) continue;
    const auto runs = chosen(scores, [&](const RunScore& score) { return is_of(score, group); });
    const Summary recall = summarize(values(runs, [](const RunScore& score) { return score.micro_recall; }));
    words.push_back(fmt::format("{} (set {})", mean_text(recall), group.set));
  }
  return joined(words);
}

/// " and models a case of set A with 10 tubes in 0.71 s on average (published: 0.85 s)"
std::string time_of(const Results& results, const std::string& method, double ratio, int tubes) {
  const auto here = chosen(results.times, [&](const RunTime& time) {
    return time.run.method == method && time.run.ratio == ratio && tubes_of(time) == tubes;
  });
  if (here.empty()) return "";
  const RunGroup group = groups_of(here).front();
  const auto times = chosen(here, [&](const RunTime& time) { return is_of(time, group); });
  const double mean = summarize(values(times, [](const RunTime& time) { return time.seconds; })).mean;
  const std::optional<double> published =
      results.is_papers ? published_modelling_time(group.set, tubes, ratio) : std::nullopt;
  return fmt::format(" and models a case of set {} with {} in {} s on average{}", group.set,
                     counted(static_cast<std::size_t>(tubes), "tube"), seconds_text(mean),
                     published ? fmt::format(" (published: {} s)", seconds_text(published)) : "");
}

/// "At downsampling ratio 0.3, “axis” has the highest mean micro-recall of 5 methods, 0.931."
std::string best_of(const std::vector<RunScore>& scores, double ratio) {
  const auto methods = distinct(scores, [](const RunScore& score) { return score.run.method; });
  const auto mean_of = [&](const std::string& method) {
    const auto runs = chosen(scores, [&](const RunScore& score) { return score.run.method == method; });
    return summarize(values(runs, [](const RunScore& score) { return score.micro_recall; })).mean;
  };
  const std::string best = *std::ranges::max_element(methods, {}, mean_of);
  if (methods.size() == 1)
    return fmt::format("At downsampling ratio {}, method “{}” has a mean micro-recall of {:.3f}.",
                       ratio_text(ratio), best, mean_of(best));
  return fmt::format("At downsampling ratio {}, method “{}” has the highest mean micro-recall of {}, {:.3f}.",
                     ratio_text(ratio), best, counted(methods.size(), "method"), mean_of(best));
}

/// One sentence per method, or only one if there are many groups.
std::string headline(const Results& results) {
  if (results.scores.empty()) return "There are no scores yet.";
  const double ratio = shown_ratio(results.scores);
  const auto scores = chosen(results.scores, [&](const RunScore& score) { return score.run.ratio == ratio; });
  constexpr std::size_t most_groups = 4;  // that a sentence can hold
  if (groups_of(scores).size() > most_groups) return best_of(scores, ratio);
  std::vector<std::string> sentences;
  for (const std::string& method : results.experiment.methods) {
    const std::string recalls = recalls_of(scores, method);
    if (recalls.empty()) continue;
    sentences.push_back(fmt::format("At downsampling ratio {}, method “{}” has a mean micro-recall of {}{}.",
                                    ratio_text(ratio), method, recalls,
                                    time_of(results, method, ratio, shown_tubes(results.scores))));
  }
  return fmt::format("{} ± is half the 95 % confidence interval of the mean.", fmt::join(sentences, " "));
}

/// Runs of a method that failed for the same reason.
struct Failures {
  std::string method;
  std::string reason;
  SeenCase first;
  std::size_t runs = 0;
};

// The most frequent first.
std::vector<Failures> failures_of(const std::vector<RunScore>& failed) {
  std::vector<Failures> all;
  for (const RunScore& score : failed) {
    auto known = std::ranges::find_if(all, [&](const Failures& its) {
      return its.method == score.run.method && its.reason == score.failure;
    });
    if (known == all.end())
      known = all.insert(all.end(), {score.run.method, score.failure, {score.run.id, score.run.scanner}});
    ++known->runs;
  }
  std::ranges::stable_sort(all, std::greater<>(), &Failures::runs);
  return all;
}

std::string on_one_line(const std::string& text) {
  constexpr std::size_t longest = 300;
  return printable(text.size() > longest ? text.substr(0, longest) + " …" : text);
}

HtmlTable table_of_failures(const std::vector<RunScore>& failed) {
  constexpr std::size_t most = 20;
  const std::vector<Failures> all = failures_of(failed);
  HtmlTable table{.caption_html = "Why runs failed. <code>results.jsonl</code> has each of them.",
                  .columns = {{"Method", ""}, {"runs", ""}, {"the first", ""}, {"reason", ""}},
                  .rows = {}};
  for (const Failures& its : all) {
    if (table.rows.size() == most) break;
    table.rows.push_back({its.method, std::to_string(its.runs), name_of(its.first), on_one_line(its.reason)});
  }
  if (all.size() > most)
    table.caption_html += fmt::format(" {} more are not shown.", counted(all.size() - most, "reason"));
  return table;
}

/// How runs without a score count, and why they failed.
std::string note_on_failures(const Results& results) {
  std::string html_text;
  const auto failed = chosen(results.scores, [](const RunScore& score) { return !score.failure.empty(); });
  if (!failed.empty()) {
    html_text += paragraph("warning", fmt::format("{} failed; a failed run counts as one that found nothing.",
                                                  counted(failed.size(), "run")));
    html_text += html(table_of_failures(failed));
  }
  const auto unscored = distinct(results.unscored, [](const RunKey& run) {
    return SeenCase{run.id, run.scanner};
  });
  if (!unscored.empty()) {
    html_text += paragraph("warning", fmt::format("{} without a visible tube, which no mean counts.",
                                                  counted(unscored.size(), "case")));
  }
  return html_text;
}

}  // namespace

std::string overview(const Results& results) {
  std::string html =
      "<header>\n<p class=\"kicker\">Tanglebin report</p>\n<h1>Modelling entangled tubes in simulated "
      "bins</h1>\n";
  if (results.unfinished) {
    html += paragraph(
        "warning",
        "This experiment is not finished: a run was interrupted or is in progress, and its latest results "
        "are not on this page. Run the same command again to resume.");
  }
  html += paragraph("lead", escaped(headline(results)));
  return html + note_on_failures(results) + facts(results) + "</header>\n";
}

}  // namespace tanglebin
