// The end of the report: the commands that make it again.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/sections.hpp"
#include "tanglebin/report/selection.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin {
namespace {

constexpr const char* continued = " \\\n ";

/// As a shell reads it: in quotes where it has to be.
std::string word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:=,+%@").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

// ---- Which cases

std::string list_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

/// "1,5,10-20"
std::string list_of(const std::vector<int>& ascending) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, last = 0; first < ascending.size(); first = ++last) {
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    ranges.push_back(first == last ? fmt::format("{}", ascending[first])
                                   : fmt::format("{}-{}", ascending[first], ascending[last]));
  }
  return list_of(ranges);
}

/// The options that choose these of all cases, such as " --tubes 1,5"; none if there are no such options.
std::optional<std::string> options_for(const std::vector<CaseId>& chosen_cases,
                                       const std::vector<CaseId>& all) {
  std::string options;
  std::vector<CaseId> selected = all;
  const auto choose = [&](const char* option, const auto& key) {
    const auto wanted = distinct(chosen_cases, key);
    if (wanted != distinct(all, key)) options += fmt::format(" {} {}", option, list_of(wanted));
    std::erase_if(selected, [&](const CaseId& id) { return !std::ranges::binary_search(wanted, key(id)); });
  };
  choose("--set", [](const CaseId& id) { return id.set; });
  choose("--tubes", [](const CaseId& id) { return id.tubes; });
  choose("--cases", [](const CaseId& id) { return id.number; });
  if (selected.size() != chosen_cases.size()) return std::nullopt;
  return options;
}

std::vector<CaseId> cases_of_dataset(const Results& results) {
  return distinct(results.generation, [](const TimesRecord& times) { return times.id; });
}

std::vector<CaseId> cases_of_results(const Results& results) {
  std::vector<CaseId> ids = distinct(results.scores, [](const RunScore& score) { return score.run.id; });
  for (const RunKey& run : results.unscored) ids.push_back(run.id);
  return distinct(ids, [](const CaseId& id) { return id; });
}

/// Of the recipe's cases, those of the dataset.
std::optional<std::string> options_of_generate(const Results& results) {
  if (!results.experiment.recipe || results.generation.empty()) return "";
  return options_for(cases_of_dataset(results), cases(*results.experiment.recipe));
}

/// Of the dataset's cases, those of the results.
std::optional<std::string> options_of_experiment(const Results& results) {
  if (results.generation.empty()) return "";
  return options_for(cases_of_results(results), cases_of_dataset(results));
}

// ---- Commands

std::string method_options(const ExperimentRecord& experiment) {
  std::string text;
  for (const std::string& method : experiment.methods) {
    const auto other = experiment.options_of_methods.find(method);
    text += continued;
    if (other == experiment.options_of_methods.end()) {
      text += " --method " + word(method);
    } else {
      const auto& [option, value] = other->second;
      text += fmt::format(" {} {}={}", option, method, word(value));
    }
  }
  return text;
}

std::string other_options(const ExperimentRecord& experiment) {
  constexpr double gibibyte = 1U << 30U;
  std::string text;
  if (experiment.time_limit) text += fmt::format(" --time-limit {}", *experiment.time_limit);
  if (experiment.memory_limit) text += fmt::format(" --memory-limit {}", *experiment.memory_limit / gibibyte);
  for (const auto& [name, value] : experiment.parameters)
    text += fmt::format("{} --parameter {}={}", continued, name, value);
  if (experiment.has_scene_file) text += " --scene scene.toml";
  return text;
}

std::string commands(const Results& results, const std::string& page) {
  const ExperimentRecord& experiment = results.experiment;
  const std::string dataset = experiment.dataset.empty() ? "dataset" : word(experiment.dataset);
  const std::string directory = word(results.directory);
  return fmt::format(
      "tanglebin generate {0}/recipe.toml --out {0}{1}\n"
      "tanglebin experiment {0} --out {2}{3}{4} --downsample {5} --seed {6}{7}\n"
      "tanglebin report {2} --out {8}\n",
      dataset, options_of_generate(results).value_or(""), directory, method_options(experiment) + continued,
      options_of_experiment(results).value_or(""), fmt::join(experiment.ratios, ","), experiment.seed,
      other_options(experiment), word(page));
}

// ---- Notes

std::string note_on_chosen_cases(const Results& results) {
  std::string html;
  if (!options_of_generate(results))
    html +=
        paragraph("note", fmt::format("The dataset has {} of the recipe's {} cases.",
                                      results.generation.size(), cases(*results.experiment.recipe).size()));
  if (results.generation.size() > results.experiment.cases)
    html += paragraph("note", fmt::format("These results cover {} of the dataset's {} cases.",
                                          results.experiment.cases, results.generation.size()));
  return html;
}

std::string note_on_scene_file(const Results& results) {
  if (!results.experiment.has_scene_file) return "";
  return paragraph(
      "note",
      "The methods were told what <code>scene.toml</code> says; <code>experiment.json</code> has it.");
}

}  // namespace

std::string how_to_repeat(const Results& results, const std::string& page) {
  return section_html(
      "repeat", "How to make this page again",
      fmt::format("<pre tabindex=\"0\"><code>{}</code></pre>\n", escaped(commands(results, page))) +
          note_on_chosen_cases(results) + note_on_scene_file(results) +
          paragraph("note",
                    fmt::format(
                        "The dataset has its recipe with every value, so another <code>--out</code> makes it "
                        "anew. With Tanglebin {}, the same recipe gives exactly the same scores. Times "
                        "differ between machines.",
                        escaped(results.experiment.version))));
}

}  // namespace tanglebin
