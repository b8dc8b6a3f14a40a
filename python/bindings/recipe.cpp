#include "tanglebin/recipe/recipe.hpp"

#include <pybind11/operators.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "long_work.hpp"
#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/expect.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/recipe/doubts.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/simulate/simulate.hpp"
#include "tanglebin/simulate/world_sdf.hpp"

namespace tanglebin::python {
namespace {

std::string recipe_text(const Recipe& recipe) {
  validate(recipe);
  return bytes_of([&](std::ostream& out) { write_recipe(out, recipe); });
}

Recipe recipe_from(const std::string& text) {
  std::istringstream in(text);
  return read_recipe(in, "recipe");
}

// A scene has at least one tube, and cases count from 1.
CaseId case_id_of(std::string set, int tubes, int number) {
  expect(tubes >= 1, "tubes", fmt::format("{}", tubes), "at least 1");
  expect(number >= 1, "number", fmt::format("{}", number), "at least 1");
  return {std::move(set), tubes, number};
}

void bind_case_id(py::module_& module) {
  py::class_<CaseId>(module, "CaseId", doc::recipe::CaseId)
      .def(py::init(&case_id_of), py::arg("set"), py::arg("tubes"), py::arg("number"),
           "Raises InputError if a number is less than 1.")
      .def_readonly("set", &CaseId::set, "the name of its set")
      .def_readonly("tubes", &CaseId::tubes, doc::recipe::CaseId_tubes)
      .def_readonly("number", &CaseId::number, doc::recipe::CaseId_number)
      .def(py::self == py::self)
      .def(py::self < py::self)
      .def("__hash__", [](const CaseId& id) { return py::hash(py::make_tuple(id.set, id.tubes, id.number)); })
      .def("__str__", [](const CaseId& id) { return name_of(id); })
      .def("__repr__", [](const CaseId& id) { return "<CaseId " + name_of(id) + ">"; })
      .def(py::pickle(
          [](const CaseId& id) { return py::make_tuple(id.set, id.tubes, id.number); },
          [](const py::tuple& state) {
            return CaseId{state[0].cast<std::string>(), state[1].cast<int>(), state[2].cast<int>()};
          }));
}

void bind_parts(py::module_& module) {
  py::class_<PointProperties>(module, "PointProperties", tanglebin::doc::scan::PointProperties)
      .def(py::init<>())
      .def_readwrite("normals", &PointProperties::normals, "outward unit normals")
      .def_readwrite("intensities", &PointProperties::intensities,
                     tanglebin::doc::scan::PointProperties_intensities)
      .def_readwrite("mixed", &PointProperties::mixed, "marks of mixed points");
  py::class_<OutputSettings>(module, "OutputSettings", doc::recipe::OutputSettings)
      .def(py::init<>())
      .def_readwrite("plys", &OutputSettings::plys, doc::recipe::OutputSettings_plys)
      .def_readwrite("bin_points", &OutputSettings::bin_points, doc::recipe::OutputSettings_bin_points)
      .def_readwrite("worlds", &OutputSettings::worlds, doc::recipe::OutputSettings_worlds)
      .def_readwrite("pcds", &OutputSettings::pcds, doc::recipe::OutputSettings_pcds)
      .def_readwrite("depths", &OutputSettings::depths, doc::recipe::OutputSettings_depths)
      .def_readwrite("labels", &OutputSettings::labels, doc::recipe::OutputSettings_labels)
      .def_readwrite("occlusions", &OutputSettings::occlusions, doc::recipe::OutputSettings_occlusions)
      .def_readwrite("properties", &OutputSettings::properties, doc::recipe::OutputSettings_properties);
  py::class_<Scanner>(module, "Scanner", doc::recipe::Scanner)
      .def(py::init([](const std::string& name, const Camera& camera, const Sensor& sensor) {
             return Scanner{name, camera, sensor};
           }),
           py::arg("name"), py::arg("camera"), py::arg("sensor"))
      .def_readwrite("name", &Scanner::name, doc::recipe::Scanner_name)
      .def_readwrite("camera", &Scanner::camera, tanglebin::doc::geometry::Camera)
      .def_readwrite("sensor", &Scanner::sensor, tanglebin::doc::scan::Sensor);
  module.def(
      "scanner_with",
      [](const std::string& preset, const std::vector<std::string>& settings) {
        return scanner_with(preset, settings, "settings");
      },
      py::arg("preset"), py::arg("settings") = std::vector<std::string>{}, doc::recipe::scanner_with);
  py::class_<SetRecipe> described(module, "SetRecipe", doc::recipe::SetRecipe);
  described
      .def(py::init([](const std::string& name, const std::vector<int>& tubes, int cases,
                       const std::vector<TubeSpec>& kinds) {
             return SetRecipe{.name = name, .tubes = tubes, .cases = cases, .kinds = kinds};
           }),
           py::arg("name"), py::arg("tubes"), py::arg("cases") = SetRecipe{}.cases,
           py::arg_v("kinds", SetRecipe{}.kinds, "[TubeSpec()]"))
      .def_readwrite("name", &SetRecipe::name, doc::recipe::SetRecipe_name)
      .def_readwrite("cases", &SetRecipe::cases, doc::recipe::SetRecipe_cases);
  def_list(described, "tubes", &SetRecipe::tubes, doc::recipe::SetRecipe_tubes);
  def_list(described, "kinds", &SetRecipe::kinds, doc::recipe::SetRecipe_kinds);
  def_list(described, "weights", &SetRecipe::weights, doc::recipe::SetRecipe_weights);
}

void bind_recipes(py::module_& module) {
  py::class_<Recipe> described(module, "Recipe", doc::recipe::Recipe);
  described.def(py::init(&recipe_from), py::arg("toml"), "Reads the text of a recipe (docs/formats.md).")
      .def("toml", &recipe_text, "The text of the recipe, resolved: every value, presets spelled out.")
      .def_readwrite("seed", &Recipe::seed, "the seed of the dataset")
      .def_readwrite("attempts", &Recipe::attempts, doc::recipe::Recipe_attempts)
      .def_readwrite("bin", &Recipe::bin, tanglebin::doc::geometry::Bin)
      .def_readwrite("scanner_name", &Recipe::scanner_name,
                     "the first scanner's; may be empty if it is the only one")
      .def_readwrite("camera", &Recipe::camera, doc::recipe::Recipe_camera)
      .def_readwrite("sensor", &Recipe::sensor, "of the first scanner")
      .def_readwrite("settle", &Recipe::settle, tanglebin::doc::settle::SettleSettings)
      .def_readwrite("output", &Recipe::output, doc::recipe::OutputSettings)
      .def_property_readonly(
          "is_random", [](const Recipe& recipe) { return !recipe.random.empty(); },
          "Whether cases draw numbers of their own; resolved() gives the recipe of a case.")
      .def_property_readonly(
          "cases", [](const Recipe& recipe) { return cases(recipe); }, doc::recipe::cases)
      .def(
          "resolved",
          [](const Recipe& recipe, const CaseId& id) {
            validate(recipe);
            return resolve(recipe, id, draw(recipe, id));
          },
          py::arg("id"), doc::recipe::resolve)
      .def(
          "validate", [](const Recipe& recipe) { validate(recipe); }, doc::recipe::validate)
      .def("doubts", &doubts, doc::recipe::doubts)
      .def(py::self == py::self)
      .def(py::pickle(&recipe_text, &recipe_from));
  def_list(described, "further_scanners", &Recipe::further_scanners, doc::recipe::Recipe_further_scanners);
  def_list(described, "sets", &Recipe::sets, "the sets of cases");
  module.def(
      "read_recipe", [](const std::filesystem::path& file) { return read_recipe(file); }, py::arg("file"),
      doc::recipe::read_recipe);
  module.def(
      "write_recipe",
      [](const std::filesystem::path& file, const Recipe& recipe) { write_file(file, recipe_text(recipe)); },
      py::arg("file"), py::arg("recipe"), doc::recipe::write_recipe);
}

void bind_simulate(py::module_& module) {
  namespace doc = tanglebin::doc::simulate;
  py::class_<Rejection>(module, "Rejection", doc::Rejection)
      .def_readonly("seed", &Rejection::seed, "of the attempt")
      .def_readonly("simulated", &Rejection::simulated, doc::Rejection_simulated)
      .def_readonly("fault", &Rejection::fault, "why it is not valid");
  py::class_<SimulatedScene>(module, "SimulatedScene", doc::SimulatedScene)
      .def_readonly("tubes", &SimulatedScene::tubes, "at rest, m, world frame")
      .def_readonly("scan", &SimulatedScene::scan, doc::SimulatedScene_scan)
      .def_readonly("further_scans", &SimulatedScene::further_scans, doc::SimulatedScene_further_scans)
      .def_readonly("seed", &SimulatedScene::seed, doc::SimulatedScene_seed)
      .def_readonly("simulated", &SimulatedScene::simulated, doc::SimulatedScene_simulated)
      .def_readonly("largest_overlap", &SimulatedScene::largest_overlap, doc::SimulatedScene_largest_overlap)
      .def_readonly("rejections", &SimulatedScene::rejections, "the attempts before")
      .def("__repr__", [](const SimulatedScene& scene) {
        return fmt::format("<SimulatedScene of {}, {}, seed {:#x}>", counted(scene.tubes.size(), "tube"),
                           counted(1 + scene.further_scans.size(), "scan"), scene.seed);
      });
  module.def(
      "simulate",
      [](const Recipe& dataset, const CaseId& id, const Progress& progress) {
        validate(dataset);
        return without_gil([&] {
          const Recipe recipe = resolve(dataset, id, draw(dataset, id));
          const SimulationTurn turn;
          Reporter reporter(progress);
          int attempts = -1;
          return simulate(
              recipe, id, [&] { ++attempts; }, [&](double) { reporter.report(attempts, recipe.attempts); });
        });
      },
      py::arg("recipe"), py::arg("id"), py::arg("progress") = py::none(),
      also(doc::simulate,
           "Takes any recipe, and draws the case's random numbers. `progress` is called with the attempts "
           "rejected so far and the most there may be. Ctrl-C raises KeyboardInterrupt. Other "
           "simulations in this process wait.")
          .c_str());
  module.def(
      "write_world",
      [](const std::filesystem::path& file, const std::vector<Tube>& tubes, const Bin& bin,
         const Camera& camera, const SettleSettings& settle) {
        write_file(file, bytes_of([&](std::ostream& out) { write_world(out, tubes, bin, camera, settle); }));
      },
      py::arg("file"), py::arg("tubes"), py::arg("bin"), py::arg("camera"),
      py::arg_v("settle", SettleSettings{}, "SettleSettings()"), doc::write_world);
}

}  // namespace

void bind_recipe(py::module_& module) {
  bind_case_id(module);
  bind_parts(module);
  bind_recipes(module);
  bind_simulate(module);
}

}  // namespace tanglebin::python
