#include "tanglebin/cli/many_cases.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/arguments.hpp"

namespace tanglebin::cli {

void add_jobs_option(CLI::App& command, int& jobs) {
  jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command.add_option("--jobs", jobs, "Number of worker processes")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
}

void add_options(CLI::App& command, ManyCases& many) {
  add_jobs_option(command, many.jobs);
  command.add_option("--set", many.sets, "Only these sets");
  command.add_option("--tubes", many.tubes, "Only these numbers of tubes");
  command.add_option("--cases", many.cases, "Only this case or range of cases: 3 or 1-20");
}

std::vector<CaseId> chosen(const ManyCases& many, std::vector<CaseId> cases, const std::string& source) {
  const auto any_of = [](const auto& list, const auto& value) {
    return list.empty() || std::ranges::find(list, value) != list.end();
  };
  std::erase_if(
      cases, [&](const CaseId& id) { return !any_of(many.sets, id.set) || !any_of(many.tubes, id.tubes); });
  if (many.cases) {
    const Range range = parse_range(*many.cases, "--cases");
    std::erase_if(cases, [&](const CaseId& id) { return id.number < range.first || id.number > range.last; });
  }
  if (cases.empty()) throw InputError({source, 0, ""}, "no case matches --set, --tubes and --cases");
  return cases;
}

}  // namespace tanglebin::cli
