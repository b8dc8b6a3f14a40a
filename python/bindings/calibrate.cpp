#include "tanglebin/calibrate/calibrate.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "long_work.hpp"
#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/profile/profile.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin::python {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

void bind_what_it_is_for(py::module_& module) {
  namespace doc = doc::profile;
  py::class_<TubesMadeFor>(module, "TubesMadeFor", doc::TubesMadeFor)
      .def_readonly("radius_min", &TubesMadeFor::radius_min, "m")
      .def_readonly("radius_max", &TubesMadeFor::radius_max, "m")
      .def_readonly("length_min", &TubesMadeFor::length_min, doc::TubesMadeFor_length_min)
      .def_readonly("length_max", &TubesMadeFor::length_max, doc::TubesMadeFor_length_min);
  py::class_<MadeFor>(module, "MadeFor", doc::MadeFor)
      .def_readonly("scanner", &MadeFor::scanner, doc::MadeFor_scanner)
      .def_readonly("image_width", &MadeFor::image_width, doc::MadeFor_image_width)
      .def_readonly("focal_length", &MadeFor::focal_length, "of the scanner's camera, pixels")
      .def_readonly("bin", &MadeFor::bin, doc::MadeFor_bin)
      .def_readonly("recipe_sha256", &MadeFor::recipe_sha256, "the recipe's SHA-256")
      .def_readonly("version", &MadeFor::version, doc::MadeFor_version)
      .def_readonly("tubes", &MadeFor::tubes, "of each kind");
}

void bind_what_it_reached(py::module_& module) {
  namespace doc = doc::profile;
  py::class_<Estimate>(module, "Estimate", tanglebin::doc::base::Estimate)
      .def_readonly("mean", &Estimate::mean, "the mean")
      .def_readonly("low", &Estimate::low, "the lower end of the interval")
      .def_readonly("high", &Estimate::high, "the upper end of the interval");
  py::class_<Reached>(module, "Reached", doc::Reached)
      .def_readonly("objective", &Reached::objective, tanglebin::doc::calibrate::Objective)
      .def_readonly("ratio", &Reached::ratio, doc::Reached_ratio)
      .def_readonly("scenes", &Reached::scenes, "how many scenes the means are over")
      .def_readonly("before", &Reached::before, "with the parameters of the start")
      .def_readonly("after", &Reached::after, "with the profile's")
      .def_readonly("difference", &Reached::difference, "scene by scene");
}

void write_profile_file(const fs::path& file, const Profile& profile, const std::string& title) {
  write_file(file, bytes_of([&](std::ostream& out) { write_profile(out, profile, title); }));
}

void bind_profiles(py::module_& module) {
  namespace doc = doc::profile;
  py::class_<Profile>(module, "Profile", doc::Profile)
      .def_readonly("parameters", &Profile::parameters, "their values, keyed by their names")
      .def_property_readonly(
          "method",
          [](const Profile& profile) {
            return profile.method ? std::optional(name_of(*profile.method)) : std::nullopt;
          },
          doc::Profile_method)
      .def_readonly("made_for", &Profile::made_for, doc::MadeFor)
      .def_readonly("reached", &Profile::reached, doc::Reached);
  module.def(
      "read_profile", [](const fs::path& file) { return read_profile(file); }, py::arg("file"),
      also(doc::read_profile, "ModelSettings(profile.method, parameters=profile.parameters) uses it.")
          .c_str());
  module.def("write_profile", &write_profile_file, py::arg("file"), py::arg("profile"),
             py::arg("title") = "Parameters of a method", doc::write_profile);
  module.def("doubts_of", &doubts_of, py::arg("profile"), py::arg("known"), doc::doubts_of);
}

void expect_within(const char* name, double value, double least, double greatest) {
  if (!(value >= least && value <= greatest))
    throw InputError({"", 0, name}, fmt::format("{}", value), fmt::format("{} to {}", least, greatest));
}

CalibrationSettings calibration_settings(const std::string& method, const std::string& objective,
                                         double ratio, int scenes, std::size_t evaluations,
                                         std::optional<double> seconds, double time_limit,
                                         const Parameters& start, int jobs) {
  constexpr double longest = 1e9;
  expect_within("ratio", ratio, 1e-6, 1);
  expect_within("scenes", scenes, 2, 100000);
  expect_within("time_limit", time_limit, 1e-3, longest);
  expect_within("seconds", seconds.value_or(1), 0, longest);
  validate_jobs(jobs);
  CalibrationSettings settings;
  settings.scoring = {.method = method_named(method),
                      .objective = objective_named(objective),
                      .ratio = ratio,
                      .scene_limit = std::chrono::duration_cast<TimeLimit>(Seconds(time_limit)),
                      .jobs = jobs};
  settings.scenes = scenes;
  settings.budget.evaluations = evaluations;
  if (seconds) settings.budget.time = Seconds(*seconds);
  settings.start = start;
  return settings;
}

Calibration calibrate_with_progress(const Recipe& recipe, const fs::path& directory,
                                    const CalibrationSettings& settings, const Progress& progress) {
  const CalibrationObserver observer{.progress = [&progress](const CalibrationProgress& so_far) {
    const py::gil_scoped_acquire acquired;
    if (progress) (*progress)(so_far.evaluations, so_far.most);
  }};
  std::optional<Calibration> calibration = without_gil([&] {
    const SimulationTurn turn;
    validate(recipe);
    return calibrate(recipe, settings, directory, observer);
  });
  if (!calibration) {
    pass_on_signal();
    PyErr_SetNone(PyExc_KeyboardInterrupt);  // the handler of the signal let it pass
    throw py::error_already_set();
  }
  return *std::move(calibration);
}

void bind_calibrations(py::module_& module) {
  namespace doc = doc::calibrate;
  const CalibrationSettings standard;
  py::class_<CalibrationSettings>(module, "CalibrationSettings", doc::CalibrationSettings)
      .def(
          py::init(&calibration_settings), py::arg("method") = name_of(standard.scoring.method),
          py::arg("objective") = name_of(standard.scoring.objective),
          py::arg("ratio") = standard.scoring.ratio, py::arg("scenes") = standard.scenes,
          py::arg("evaluations") = standard.budget.evaluations, py::arg("seconds") = py::none(),
          py::arg("time_limit") = Seconds(standard.scoring.scene_limit).count(),
          py::arg("start") = standard.start, py::arg("jobs") = standard.scoring.jobs,
          "The budget is a number of evaluations, each a scene modelled once, and seconds if given; the time "
          "limit of a scene is in seconds.");
  py::class_<Sensitivity>(module, "Sensitivity", doc::Sensitivity)
      .def_readonly("name", &Sensitivity::name, "of the parameter")
      .def_readonly("down", &Sensitivity::down, doc::Sensitivity_down)
      .def_readonly("up", &Sensitivity::up, doc::Sensitivity_down);
  py::class_<Calibration>(module, "Calibration", doc::Calibration)
      .def_readonly("profile", &Calibration::profile, doc::Calibration_profile)
      .def_readonly("sensitivities", &Calibration::sensitivities, doc::Calibration_sensitivities)
      .def_readonly("evaluations", &Calibration::evaluations, "of the search")
      .def_readonly("is_better", &Calibration::is_better, doc::Calibration_is_better);
  module.def(
      "calibrate", &calibrate_with_progress, py::arg("recipe"), py::arg("directory"),
      py::arg_v("settings", standard, "CalibrationSettings()"), py::arg("progress") = py::none(),
      also(doc::calibrate,
           "`progress` is called with the evaluations done so far and all that there may be. Ctrl-C stops "
           "after the scenes in progress, keeps what is done and raises KeyboardInterrupt; call it again to "
           "go on.")
          .c_str());
}

}  // namespace

void bind_calibrate(py::module_& module) {
  bind_what_it_is_for(module);
  bind_what_it_reached(module);
  bind_profiles(module);
  bind_calibrations(module);
}

}  // namespace tanglebin::python
