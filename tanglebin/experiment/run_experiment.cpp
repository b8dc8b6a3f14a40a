#include "tanglebin/experiment/run_experiment.hpp"

#include <optional>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/verify_case.hpp"
#include "tanglebin/experiment/kept_models.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

// The lines that lines_of(entry, run) gives for each run of a cloud.
template <typename LinesOf>
Lines lines_of_runs(const ExperimentSettings& settings, const SeenCase& seen, const LinesOf& lines_of) {
  Lines all;
  for (const Entry& entry : settings.methods) {
    for (const double ratio : settings.ratios) {
      for (std::string& line : lines_of(entry, RunId{entry.name, seen.scene, ratio, seen.scanner}))
        all.push_back(std::move(line));
    }
  }
  return all;
}

Lines failed_runs(const CaseRecord& record, const ExperimentSettings& settings, const SeenCase& seen,
                  const RunFailure& failure) {
  return lines_of_runs(settings, seen, [&](const Entry& /*all*/, const RunId& run) {
    return Lines{failure_json(run, record, failure)};
  });
}

/// Where a run of an experiment writes.
struct Place {
  fs::path results;
  fs::path scratch;  ///< for files that do not stay
  int jobs;
};

// The checksum of labels that exist, before they are read: if they change meanwhile, they are scored again.
std::optional<std::string> labels_of(const Entry& entry, const RunId& run) {
  const auto* directory = std::get_if<LabelsDirectory>(&entry.what);
  return directory ? std::optional(labels_sha256(*directory, run)) : std::nullopt;
}

/// What a method made of a cloud, and how good it is.
struct Scored {
  Modelled modelled;
  ModelScore score;
};

Lines lines_of(const RunId& run, const CaseRecord& record, const Scored& scored, const Place& place) {
  Lines lines{result_json(run, record, scored.modelled, scored.score)};
  if (scored.modelled.seconds) lines.push_back(times_json(run, scored.modelled, circumstances(place.jobs)));
  return lines;
}

Lines run_cloud(const Dataset& dataset, const ExperimentSettings& settings, const SeenCase& seen,
                const Place& place) {
  const CaseData data = read_seen_case(dataset, seen);
  const CaseRecord record = dataset.catalogue.record(seen.scene);
  if (const std::optional<RunFailure> failure = failure_of_scene(data.cloud.labels))
    return failed_runs(record, settings, seen, *failure);
  const Recipe recipe = recipe_seen(dataset, seen);
  const auto score_by = [&](const Entry& entry, const RunId& run) -> Scored {
    const KnownScene known = told_scene(recipe, data, seen.scene, settings.scene);
    Modelled modelled = model_by(entry, known, data, run, settings, place.scratch);
    ModelScore score = score_model(data, modelled.model, modelled.has_tubes);
    return {std::move(modelled), std::move(score)};
  };
  return lines_of_runs(settings, seen, [&](const Entry& entry, const RunId& run) -> Lines {
    const std::optional<std::string> labels = labels_of(entry, run);
    std::optional<Scored> scored;
    try {
      scored = score_by(entry, run);
    } catch (const InputError& error) {
      return {failure_json(run, record, {FailureOf::method, complaint_of(error)}, labels)};
    }
    if (settings.keep_models) keep_model(place.results, run, data.cloud, scored->modelled.model);
    return lines_of(run, record, *scored, place);
  });
}

// The journal line for a case with the lines that lines_of(seen case) gives for each of its clouds.
template <typename LinesOf>
std::string journal_line_of(const Dataset& dataset, const CaseId& id, const LinesOf& lines_of) {
  Lines all;
  for (const Scanner& scanner : scanners(dataset.recipe)) {
    for (std::string& line : lines_of(SeenCase{id, scanner.name})) all.push_back(std::move(line));
  }
  return journal_line(all);
}

// Whether the models of a finished case were kept; a run that failed has none.
bool has_models(const fs::path& directory, const FinishedRuns& finished, const RunGrid& grid,
                const CaseId& id) {
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const RunId run = grid.run(i, id);
    if (!finished.is_failed(run) && !has_model(directory, run)) return false;
  }
  return true;
}

FinishedRuns finished_runs(const fs::path& directory, const RunGrid& grid) {
  FinishedRuns finished(grid);
  finished.add(directory);
  return finished;
}

}  // namespace

ExperimentSummary run_experiment(const Dataset& dataset, const ExperimentSettings& settings,
                                 const std::vector<CaseId>& wanted, const std::filesystem::path& directory,
                                 int jobs, const RunObserver& observer) {
  validate_jobs(jobs);
  expect_names(settings.methods);
  for (const Entry& entry : settings.methods) {
    if (const auto* method = std::get_if<Method>(&entry.what)) expect_available(*method);
    if (const auto* own = std::get_if<BuiltIn>(&entry.what)) expect_available(own->method);
    if (const auto* labels = std::get_if<LabelsDirectory>(&entry.what))
      expect_there(*labels, settings.ratios);
  }
  expect_free(directory, dataset, settings);
  expect_clouds(dataset);
  make_directories(directory);
  const Journal journal(directory);
  claim(directory, dataset, settings, journal.staging());
  const RunGrid grid = grid_of(settings, dataset.recipe);
  const auto fold_journal = [&](const FinishedRuns& finished) {
    write_results(directory, dataset, settings, finished, journal.staging());
    journal.clear();
  };
  // The error that ended the run is the one to report; the journal keeps what cannot be written now.
  const auto fold_after_an_error = [&] {
    try {
      fold_journal(finished_runs(directory, grid));
    } catch (const std::exception&) {
      return;
    }
  };
  FinishedRuns before = finished_runs(directory, grid);
  before.forget_changed(dataset, settings);
  fold_journal(before);
  std::vector<CaseId> missing;
  for (const CaseId& id : wanted) {
    if (!before.has(id) || (settings.keep_models && !has_models(directory, before, grid, id)))
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
    const CaseRecord of_case = dataset.catalogue.record(id);
    journal.append({journal_line_of(dataset, id, [&](const SeenCase& seen) {
      return failed_runs(of_case, settings, seen, {FailureOf::worker, failure.reason});
    })});
    ++summary.progress.failed;
    summary.failed.push_back({id, failure.reason});
    observer.ended({id, 0, 0, failure.reason}, summary.progress);
  };
  observer.begun(missing);
  const Place place{directory, journal.staging(), jobs};
  const auto run_case = [&](std::size_t task) {
    return journal_line_of(dataset, missing[task],
                           [&](const SeenCase& seen) { return run_cloud(dataset, settings, seen, place); });
  };
  try {
    run_in_workers(jobs, missing.size(), run_case,
                   {.done = record,
                    .failed = give_up,
                    .tick = [&] { observer.progress(summary.progress); },
                    .stopping = observer.stopping});
  } catch (...) {
    fold_after_an_error();
    throw;
  }
  fold_journal(finished_runs(directory, grid));
  return summary;
}

}  // namespace tanglebin
