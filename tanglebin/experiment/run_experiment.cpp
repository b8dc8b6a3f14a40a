#include "tanglebin/experiment/run_experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/verify_case.hpp"
#include "tanglebin/experiment/kept_models.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/io/safe_file.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

using Lines = std::vector<std::string>;

// The journal line for a case with the lines that lines_of(run) gives for each of its runs.
template <typename LinesOf>
std::string lines_of_runs(const ExperimentSettings& settings, const CaseId& id, const LinesOf& lines_of) {
  Lines all;
  for (const Method method : settings.methods) {
    for (const double ratio : settings.ratios) {
      for (std::string& line : lines_of(RunId{method, id, ratio})) all.push_back(std::move(line));
    }
  }
  return journal_line(all);
}

std::string failed_case(const Dataset& dataset, const ExperimentSettings& settings, const CaseId& id,
                        const RunFailure& failure) {
  const std::string sha256 = case_sha256(dataset, id);
  return lines_of_runs(settings, id,
                       [&](const RunId& run) { return Lines{failure_json(run, sha256, failure)}; });
}

// Runs everything for one case; returns its journal line.
std::string run_case(const Dataset& dataset, const ExperimentSettings& settings, const CaseId& id,
                     const std::filesystem::path& directory) {
  const CaseData data = read_case(dataset, id);
  if (std::ranges::none_of(data.cloud.labels, [](std::int32_t label) { return label > bin_label; })) {
    return failed_case(dataset, settings, id, {FailureOf::scene, "no point of the cloud is on a tube"});
  }
  const std::string sha256 = case_sha256(dataset, id);
  const Recipe recipe = recipe_of(dataset, id);
  return lines_of_runs(settings, id, [&](const RunId& run) -> Lines {
    try {
      const KnownScene known = known_scene(recipe, data, id, settings.scene);
      const Clock::time_point start = Clock::now();
      const Model model = model_case(known, data, run, settings);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (settings.keep_models) keep_model(directory, run, data.cloud, model);
      return {result_json(run, sha256, model, score_model(data, model)), times_json(run, model, seconds)};
    } catch (const InputError& error) {
      return {failure_json(run, sha256, {FailureOf::method, complaint_of(error)})};
    }
  });
}

// Whether the models of a finished case were kept; a run that failed has none.
bool has_models(const std::filesystem::path& directory, const FinishedRuns& finished,
                const ExperimentSettings& settings, const CaseId& id) {
  return std::ranges::all_of(settings.methods, [&](Method method) {
    return std::ranges::all_of(settings.ratios, [&](double ratio) {
      const RunId run{method, id, ratio};
      return finished.results.at(run).failure || has_model(directory, run);
    });
  });
}

}  // namespace

ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const RunObserver& observer) {
  for (const Method method : settings.methods) expect_available(method);
  expect_free(directory, dataset, settings);
  expect_clouds(dataset);
  make_directories(directory);
  const Journal journal(directory);
  claim(directory, dataset, settings);
  const auto fold_journal = [&](const FinishedRuns& finished) {
    write_results(directory, dataset, settings, finished);
    journal.clear();
  };
  FinishedRuns before = finished_runs(directory);
  before.forget_changed_cases(dataset);
  fold_journal(before);
  std::vector<CaseId> missing;
  for (const CaseId& id : wanted) {
    if (!before.has(id, settings) || (settings.keep_models && !has_models(directory, before, settings, id)))
      missing.push_back(id);
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
    const CaseId& id = missing[failure.task];
    journal.append({failed_case(dataset, settings, id, {FailureOf::worker, failure.reason})});
    ++summary.progress.failed;
    summary.failed.push_back({id, failure.reason});
    observer.ended({id, 0, 0, failure.reason}, summary.progress);
  };
  observer.begun(missing);
  try {
    run_in_workers(jobs, missing.size(),
                   [&](std::size_t task) { return run_case(dataset, settings, missing[task], directory); },
                   {.done = record,
                    .failed = give_up,
                    .tick = [&] { observer.progress(summary.progress); },
                    .stopping = observer.stopping});
  } catch (...) {
    fold_journal(finished_runs(directory));
    throw;
  }
  fold_journal(finished_runs(directory));
  return summary;
}

}  // namespace tanglebin
