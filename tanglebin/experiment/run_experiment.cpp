#include "tanglebin/experiment/run_experiment.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "tanglebin/dataset/directory_lock.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/safe_file.hpp"
#include "tanglebin/experiment/results.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

// All runs of one case; returns what the journal is to have of them.
std::string run_case(const Dataset& dataset, const ExperimentSettings& settings, const CaseId& id) {
  const CaseData data = read_case(dataset, id);
  std::vector<std::string> lines;
  for (const Method method : settings.methods) {
    for (const double ratio : settings.ratios) {
      const RunId run{method, id, ratio};
      const Clock::time_point start = Clock::now();
      const Model model = model_case(dataset, data, run, settings.seed);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      lines.push_back(result_json(run, model, score_model(data, model)));
      lines.push_back(times_json(run, model, seconds));
    }
  }
  return journal_line(lines);
}

}  // namespace

ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const Progress& progress) {
  make_directories(directory);
  const DirectoryLock lock(directory);
  claim(directory, dataset, settings);
  const FinishedRuns before = finished_runs(directory);
  write_results(directory, dataset, settings,
                before);  // also clears away a journal whose last line is cut off
  std::vector<CaseId> missing;
  for (const CaseId& id : wanted) {
    if (!before.has(id, settings)) missing.push_back(id);
  }
  ExperimentSummary summary{.wanted = wanted.size(), .found = wanted.size() - missing.size(), .made = 0};

  const auto finish = [&] {
    const FinishedRuns after = finished_runs(directory);
    const auto made =
        std::ranges::count_if(missing, [&](const CaseId& id) { return after.has(id, settings); });
    summary.made = static_cast<std::size_t>(made);
    write_results(directory, dataset, settings, after);
  };
  run_with_journal(
      directory, jobs, missing.size(),
      [&](std::size_t task) { return run_case(dataset, settings, missing[task]); },
      [&](std::size_t done) { progress(summary.found + done); }, finish);
  return summary;
}

}  // namespace tanglebin
