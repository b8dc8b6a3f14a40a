#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "long_work.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/compare.hpp"
#include "tanglebin/experiment/run_experiment.hpp"
#include "tanglebin/experiment/score_dataset.hpp"
#include "tanglebin/report/page.hpp"
#include "tanglebin/report/results.hpp"
#include "tanglebin/report/write_pictures.hpp"
#include "tanglebin/report/write_scenes.hpp"

namespace tanglebin::python {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

ProcessLimits limits_of_command(std::optional<double> seconds, std::optional<std::uint64_t> bytes) {
  constexpr double longest = 1e9;
  ProcessLimits limits = default_limits();
  if (seconds && !(*seconds > 0 && *seconds <= longest))
    throw InputError({"", 0, "time_limit"}, fmt::format("{}", *seconds), "more than 0, at most 1e9 s");
  if (seconds) limits.time = std::chrono::duration_cast<TimeLimit>(Seconds(*seconds));
  limits.memory = bytes;
  return limits;
}

Entry entry_of_arguments(const std::string& name, const std::optional<std::string>& command,
                         const std::optional<fs::path>& labels, std::optional<double> time_limit,
                         std::optional<std::uint64_t> memory_limit) {
  if (command && labels)
    throw InputError({"", 0, "labels"}, "a command and labels", "one of them, or none for a built-in method");
  if (command)
    return {name, command_of(*command, fs::current_path(), limits_of_command(time_limit, memory_limit))};
  if (labels) return {name, LabelsDirectory{fs::absolute(*labels).lexically_normal().string()}};
  return entry_of(method_named(name));
}

ExperimentSettings experiment_settings(const std::vector<Entry>& methods, const std::vector<double>& ratios,
                                       const ModelSettings& model, const Scene& scene, bool keep_models) {
  expect_names(methods);
  double last = 0;
  for (const double ratio : ratios) {
    if (!(ratio > last && ratio <= 1))
      throw InputError({"", 0, "ratios"}, fmt::format("{}", ratio),
                       "ratios above 0 and at most 1, ascending");
    last = ratio;
  }
  if (ratios.empty()) throw InputError({"", 0, "ratios"}, "none", "at least one");
  return {.methods = methods, .ratios = ratios, .model = model, .scene = scene, .keep_models = keep_models};
}

void bind_entries(py::module_& module) {
  namespace doc = doc::experiment;
  py::class_<Entry>(module, "Entry", doc::Entry)
      .def(py::init(&entry_of_arguments), py::arg("name"), py::arg("command") = py::none(),
           py::arg("labels") = py::none(), py::arg("time_limit") = py::none(),
           py::arg("memory_limit") = py::none(),
           "A method that is built in, \"axis\" or \"paper\"; a command for each cloud, with limits in s and "
           "bytes; or a directory of labels that exist already (docs/benchmark.md).")
      .def_readonly("name", &Entry::name, "its name in the results");
  py::class_<ExperimentSettings>(module, "ExperimentSettings", doc::ExperimentSettings)
      .def(py::init(&experiment_settings), py::arg("methods"), py::arg("ratios") = std::vector<double>{1},
           py::arg_v("model", ModelSettings{}, "ModelSettings()"), py::arg_v("scene", Scene{}, "Scene()"),
           py::arg("keep_models") = false)
      .def_readonly("methods", &ExperimentSettings::methods, "in the order of the results")
      .def_readonly("ratios", &ExperimentSettings::ratios, doc::ExperimentSettings_ratios)
      .def_readonly("model", &ExperimentSettings::model, doc::ExperimentSettings_model)
      .def_readonly("scene", &ExperimentSettings::scene, doc::ExperimentSettings_scene)
      .def_readonly("keep_models", &ExperimentSettings::keep_models, doc::ExperimentSettings_keep_models);
}

ExperimentSummary experiment(const fs::path& dataset, const ExperimentSettings& settings,
                             const fs::path& directory, const std::optional<std::vector<CaseId>>& wanted,
                             int jobs, const Progress& progress) {
  const RunObserver observer = observer_of(progress);
  ExperimentSummary summary = without_gil([&] {
    const SimulationTurn turn;
    const Dataset read = read_dataset(dataset);
    return run_experiment(read, settings, wanted ? *wanted : cases(read), directory, jobs, observer);
  });
  if (summary.was_stopped()) pass_on_signal();
  return summary;
}

void bind_experiments(py::module_& module) {
  namespace doc = doc::experiment;
  py::class_<FailedModel>(module, "FailedModel", doc::FailedModel)
      .def_readonly("id", &FailedModel::id, "the case")
      .def_readonly("reason", &FailedModel::reason, "why");
  py::class_<ExperimentSummary>(module, "ExperimentSummary", doc::ExperimentSummary)
      .def_readonly("progress", &ExperimentSummary::progress, doc::ExperimentSummary_progress)
      .def_readonly("failed", &ExperimentSummary::failed, doc::FailedModel)
      .def_property_readonly("is_complete", &ExperimentSummary::is_complete,
                             "whether all cases asked for are there");
  module.def(
      "run_experiment", &experiment, py::arg("dataset"), py::arg("settings"), py::arg("directory"),
      py::arg("wanted") = py::none(), py::arg("jobs") = 1, py::arg("progress") = py::none(),
      also(doc::run_experiment,
           "`dataset` is its directory. `progress` is called with the cases done so far and all that are "
           "wanted. Ctrl-C finishes the cases in progress, keeps what is done and raises "
           "KeyboardInterrupt; call it again to go on.")
          .c_str());
}

void bind_comparisons(py::module_& module) {
  namespace doc = doc::experiment;
  py::class_<Contestant>(module, "Contestant", doc::Contestant)
      .def(py::init([](const fs::path& results, const std::string& method) {
             return Contestant{results, method};
           }),
           py::arg("results"), py::arg("method"))
      .def_readonly("results", &Contestant::results, "the directory of the results")
      .def_readonly("method", &Contestant::method, "the method's name there");
  py::class_<MeasureDifference>(module, "MeasureDifference", doc::MeasureDifference)
      .def_readonly("measure", &MeasureDifference::measure, doc::MeasureDifference_measure)
      .def_readonly("baseline", &MeasureDifference::baseline, "the mean of the baseline")
      .def_readonly("other", &MeasureDifference::other, "the mean of the other")
      .def_readonly("difference", &MeasureDifference::difference, doc::MeasureDifference_difference)
      .def_readonly("low", &MeasureDifference::low, "the lower end of the interval")
      .def_readonly("high", &MeasureDifference::high, "the upper end of the interval");
  py::class_<SceneDifference>(module, "SceneDifference", doc::SceneDifference)
      .def_readonly("id", &SceneDifference::scene, "the case")
      .def_readonly("baseline", &SceneDifference::baseline, "the micro-recall of the baseline")
      .def_readonly("other", &SceneDifference::other, "the micro-recall of the other")
      .def_property_readonly("difference", &SceneDifference::difference, doc::MeasureDifference_difference);
  py::class_<Comparison>(module, "Comparison", doc::Comparison)
      .def_readonly("baseline", &Comparison::baseline, "with whom the other is compared")
      .def_readonly("other", &Comparison::other, "who is compared")
      .def_readonly("scenes", &Comparison::scenes, "how many scenes both have")
      .def_readonly("unpaired", &Comparison::unpaired, doc::Comparison_unpaired)
      .def_readonly("measures", &Comparison::measures, doc::MeasureDifference)
      .def_readonly("better", &Comparison::better, doc::Comparison_better)
      .def_readonly("worse", &Comparison::worse, "scenes, the one with the smallest difference first");
  module.def("pairs_to_compare", &pairs_to_compare, py::arg("results"), py::arg("baseline") = py::none(),
             doc::pairs_to_compare);
  module.def(
      "compare",
      [](const Contestant& baseline, const Contestant& other) {
        return without_gil([&] { return compare(baseline, other); });
      },
      py::arg("baseline"), py::arg("other"), doc::compare);
}

std::vector<MeanScore> mean_scores(const std::vector<SceneScore>& scenes) {
  std::vector<MeanScore> means;
  for (const SceneScore& scene : scenes) add(means, scene);
  return means;
}

void bind_scene_scores(py::module_& module) {
  namespace doc = doc::experiment;
  py::class_<SceneScore>(module, "SceneScore", doc::SceneScore)
      .def_property_readonly(
          "id", [](const SceneScore& scene) { return scene.seen.scene; }, "the case")
      .def_property_readonly(
          "scanner", [](const SceneScore& scene) { return scene.seen.scanner; },
          tanglebin::doc::dataset::SeenCase_scanner)
      .def_property_readonly(
          "labels",
          [](const SceneScore& scene) {
            return scene.score ? std::optional(scene.score->labels) : std::nullopt;
          },
          doc::SceneScore_score)
      .def_property_readonly(
          "tubes", [](const SceneScore& scene) { return scene.score ? scene.score->tubes : std::nullopt; },
          doc::ModelScore_tubes)
      .def_property_readonly(
          "failure",
          [](const SceneScore& scene) {
            return scene.failure ? std::optional(scene.failure->reason) : std::nullopt;
          },
          "why it has no score; None if it has one");
  py::class_<MeanScore>(module, "MeanScore", doc::MeanScore)
      .def_readonly("set", &MeanScore::set, "the name of the set")
      .def_readonly("scanner", &MeanScore::scanner, "the scanner's name; empty for the one [scanner]")
      .def_readonly("tubes", &MeanScore::tubes, "in each scene")
      .def_readonly("scenes", &MeanScore::scenes, "how many scenes the means are over")
      .def_readonly("failed", &MeanScore::failed, doc::MeanScore_failed)
      .def_readonly("micro_recall", &MeanScore::micro_recall, "the mean")
      .def_readonly("mean_iou", &MeanScore::mean_iou, "the mean")
      .def_readonly("f1", &MeanScore::f1, "the mean")
      .def_readonly("panoptic_quality", &MeanScore::panoptic_quality, "the mean")
      .def_readonly("adjusted_rand_index", &MeanScore::adjusted_rand_index, "the mean");
  module.def("mean_scores", &mean_scores, py::arg("scenes"), doc::MeanScore);
}

// Draws what results show; interruptible between two runs.
template <typename Draw>
void draw_results(const fs::path& results, const fs::path& dataset, const ExperimentSettings& settings,
                  const Draw& draw_from) {
  without_gil([&] {
    const SimulationTurn turn;
    const Dataset read = read_dataset(dataset);
    ModelAgain model_again(results, read, settings, ctrl_c_taker());
    draw_from(read, model_again);
  });
}

void bind_reports(py::module_& module) {
  namespace doc = doc::report;
  const char* const note = "`dataset` is its directory. Ctrl-C raises KeyboardInterrupt between two runs.";
  module.def(
      "write_pictures",
      [](const fs::path& directory, const fs::path& dataset, const ExperimentSettings& settings) {
        draw_results(directory, dataset, settings, [&](const Dataset& read, ModelAgain& model_again) {
          write_pictures(directory, read, settings, model_again);
        });
      },
      py::arg("directory"), py::arg("dataset"), py::arg("settings"), also(doc::write_pictures, note).c_str());
  module.def(
      "write_scenes",
      [](const fs::path& directory, const fs::path& dataset, const ExperimentSettings& settings,
         std::size_t count) {
        draw_results(directory, dataset, settings, [&](const Dataset& read, ModelAgain& model_again) {
          write_scenes(directory, read, settings, count, model_again);
        });
      },
      py::arg("directory"), py::arg("dataset"), py::arg("settings"), py::arg("count") = 3,
      also(doc::write_scenes, note).c_str());
  module.def(
      "report_page",
      [](const fs::path& results, const std::string& page) {
        return without_gil([&] { return report_page(read_results_directory(results), page); });
      },
      py::arg("results"), py::arg("page") = "report.html",
      also(doc::report_page, "`results` is the directory of the results.").c_str());
}

}  // namespace

void bind_experiment(py::module_& module) {
  bind_entries(module);
  bind_experiments(module);
  bind_comparisons(module);
  bind_scene_scores(module);
  bind_reports(module);
}

}  // namespace tanglebin::python
