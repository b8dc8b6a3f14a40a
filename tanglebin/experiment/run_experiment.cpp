#include "tanglebin/experiment/run_experiment.hpp"

#include <chrono>
#include <string>

#include "tanglebin/experiment/results.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

// Runs everything for one case; returns its journal line.
std::string run_case(const Dataset& dataset, const ExperimentSettings& settings, const CaseId& id) {
  const CaseData data = read_case(dataset, id);
  std::vector<std::string> lines;
  for (const Method method : settings.methods) {
    for (const double ratio : settings.ratios) {
      const RunId run{method, id, ratio};
      const Clock::time_point start = Clock::now();
      const Model model = model_case(dataset, data, run, settings);
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
                                 int jobs, const RunObserver& observer) {
  for (const Method method : settings.methods) expect_available(method);
  expect_clouds(dataset);
  make_directories(directory);
  const Journal journal(directory);
  claim(directory, dataset, settings);
  const auto fold_journal = [&](const FinishedRuns& finished) {
    write_results(directory, dataset, settings, finished);
    journal.clear();
  };
  const FinishedRuns before = finished_runs(directory);
  fold_journal(before);
  std::vector<CaseId> missing;
  for (const CaseId& id : wanted) {
    if (!before.has(id, settings)) missing.push_back(id);
  }
  ExperimentSummary summary;
  summary.progress.wanted = wanted.size();
  summary.progress.found = wanted.size() - missing.size();

  const auto record = [&](const std::vector<TaskResult>& results) {
    std::vector<std::string> lines;
    lines.reserve(results.size());
    for (const TaskResult& result : results) lines.push_back(result.text);
    journal.append(lines);
    for (const TaskResult& result : results) {
      ++summary.progress.made;
      observer.ended({missing[result.task], result.seconds, 0, {}}, summary.progress);
    }
  };
  const auto give_up = [&](const TaskFailure& failure) {
    ++summary.progress.failed;
    summary.failed.push_back({missing[failure.task], failure.reason});
    observer.ended({missing[failure.task], 0, 0, failure.reason}, summary.progress);
  };
  try {
    run_in_workers(jobs, missing.size(),
                   [&](std::size_t task) { return run_case(dataset, settings, missing[task]); },
                   {.done = record, .failed = give_up, .tick = [&] { observer.progress(summary.progress); }});
  } catch (...) {
    fold_journal(finished_runs(directory));
    throw;
  }
  fold_journal(finished_runs(directory));
  return summary;
}

}  // namespace tanglebin
