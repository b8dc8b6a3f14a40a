#include "tanglebin/cli/options/many_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/checks.hpp"

namespace tanglebin::cli {
namespace {

// As parse_numbers() reads them: "1,5,10-20".
std::string text_of(const std::set<int>& numbers) {
  std::vector<Range> ranges;
  for (const int number : numbers) {
    if (ranges.empty() || number != ranges.back().last + 1) ranges.push_back({number, number});
    ranges.back().last = number;
  }
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const auto& [first, last] : ranges)
    texts.push_back(first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last));
  return fmt::format("{}", fmt::join(texts, ","));
}

// "set A with 1,5,10-20 tubes and cases 1-3; set B with …".
std::string summary_of(const std::vector<CaseId>& cases) {
  std::map<std::string, std::pair<std::set<int>, std::set<int>>> sets;
  for (const CaseId& id : cases) {
    auto& [tubes, numbers] = sets[id.set];
    tubes.insert(id.tubes);
    numbers.insert(id.number);
  }
  std::vector<std::string> texts;
  texts.reserve(sets.size());
  for (const auto& [set, numbers] : sets)
    texts.push_back(fmt::format("set {} with {} tubes and cases {}", set, text_of(numbers.first),
                                text_of(numbers.second)));
  return texts.empty() ? "no cases" : fmt::format("{}", fmt::join(texts, "; "));
}

// Only the cases with these numbers, where the option is given.
void keep(std::vector<CaseId>& cases, int CaseId::*number, const std::optional<std::string>& text,
          const std::string& option) {
  if (!text) return;
  const std::vector<Range> ranges = parse_numbers(*text, option);
  std::erase_if(cases, [&](const CaseId& id) { return !contains(ranges, id.*number); });
}

}  // namespace

void add_jobs_option(CLI::App& command, int& jobs) {
  constexpr int most = 1024;
  jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command.add_option("--jobs", jobs, "Number of worker processes")
      ->capture_default_str()
      ->check(whole_number(1, most));
}

void add_options(CLI::App& command, ManyCases& many) {
  add_jobs_option(command, many.jobs);
  command.add_option("--set", many.sets, "Only these sets: A or A,B")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAMES");
  command.add_option("--tubes", many.tubes, "Only these numbers of tubes: 3, 1-20 or 1,5,10-20")
      ->option_text("NUMBERS");
  command.add_option("--cases", many.cases, "Only these cases: 3, 1-20 or 1,5,10-20")->option_text("NUMBERS");
}

std::vector<CaseId> chosen(const ManyCases& many, std::vector<CaseId> cases, const std::string& source) {
  const std::vector<CaseId> all = cases;
  std::erase_if(cases, [&](const CaseId& id) {
    return !many.sets.empty() && std::ranges::find(many.sets, id.set) == many.sets.end();
  });
  keep(cases, &CaseId::tubes, many.tubes, "--tubes");
  keep(cases, &CaseId::number, many.cases, "--cases");
  if (cases.empty())
    throw InputError({source, 0, ""},
                     "no case matches --set, --tubes and --cases; there are " + summary_of(all));
  return cases;
}

}  // namespace tanglebin::cli
