#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "long_work.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/model/tubes_json.hpp"
#include "tanglebin/report/text.hpp"

namespace tanglebin::python {
namespace {

ModelSettings settings_of(const std::string& method, double ratio, std::uint64_t seed,
                          const std::map<std::string, double>& parameters) {
  ModelSettings settings;
  settings.method = method_named(method);
  settings.ratio = ratio;
  settings.seed = seed;
  for (const auto& [name, value] : parameters)
    set_parameter(settings, fmt::format("{}={}", name, value), "parameters");
  return settings;
}

void bind_settings(py::module_& module) {
  py::class_<ModelSettings>(module, "ModelSettings", doc::model::ModelSettings)
      .def(py::init(&settings_of), py::arg("method") = name_of(ModelSettings{}.method),
           py::arg("ratio") = 1.0, py::arg("seed") = 0,
           py::arg("parameters") = std::map<std::string, double>{},
           "The method is \"axis\" or \"paper\"; the parameters are keyed by their names, such as "
           "\"axis.vote.floor_margin\".")
      .def_property_readonly(
          "method", [](const ModelSettings& settings) { return name_of(settings.method); },
          doc::model::Method)
      .def_readwrite("ratio", &ModelSettings::ratio, doc::model::ModelSettings_ratio)
      .def_readwrite("seed", &ModelSettings::seed, doc::model::ModelSettings_seed)
      .def_property_readonly("parameters", &parameters, doc::model::parameters)
      .def_property_readonly("changed_parameters", &changed_parameters, doc::model::changed_parameters)
      .def(py::pickle(
          [](const ModelSettings& settings) {
            return py::make_tuple(name_of(settings.method), settings.ratio, settings.seed,
                                  changed_parameters(settings));
          },
          [](const py::tuple& state) {
            return settings_of(state[0].cast<std::string>(), state[1].cast<double>(),
                               state[2].cast<std::uint64_t>(),
                               state[3].cast<std::map<std::string, double>>());
          }));
}

void bind_evidence(py::module_& module) {
  py::class_<TubeJoin>(module, "TubeJoin", doc::model::TubeJoin)
      .def_property_readonly(
          "from_point", [](const TubeJoin& join) { return array_of(join.from); }, doc::model::TubeJoin_from)
      .def_property_readonly(
          "to_point", [](const TubeJoin& join) { return array_of(join.to); }, doc::model::TubeJoin_from)
      .def_readonly("log_odds", &TubeJoin::log_odds, doc::model::TubeJoin_log_odds)
      .def_readonly("margin", &TubeJoin::margin, doc::model::TubeJoin_margin);
  py::class_<TubeEvidence>(module, "TubeEvidence", doc::model::TubeEvidence)
      .def_readonly("kind", &TubeEvidence::kind, doc::model::TubeEvidence_kind)
      .def_readonly("joins", &TubeEvidence::joins, doc::model::TubeEvidence_joins)
      .def_readonly("points", &TubeEvidence::points, doc::model::TubeEvidence_points)
      .def_readonly("residual", &TubeEvidence::residual, doc::model::TubeEvidence_residual)
      .def_readonly("radius_error", &TubeEvidence::radius_error, doc::model::TubeEvidence_radius_error)
      .def_readonly("disagreement", &TubeEvidence::disagreement, doc::model::TubeEvidence_disagreement)
      .def_readonly("length", &TubeEvidence::length, doc::model::TubeEvidence_length)
      .def_readonly("visible_length", &TubeEvidence::visible_length, doc::model::TubeEvidence_visible_length)
      .def_property_readonly("coverage", &TubeEvidence::coverage, doc::model::TubeEvidence_coverage)
      .def_property_readonly(
          "length_fit", [](const TubeEvidence& evidence) { return name_of(evidence.length_fit); },
          doc::model::LengthFit)
      .def_readonly("confidence", &TubeEvidence::confidence, doc::model::TubeEvidence_confidence);
  py::class_<EstimatedLength>(module, "EstimatedLength", doc::model::EstimatedLength)
      .def_readonly("kind", &EstimatedLength::kind, doc::model::EstimatedLength_kind)
      .def_readonly("length", &EstimatedLength::length, doc::model::EstimatedLength_length);
  py::class_<PointCounts>(module, "PointCounts", doc::model::PointCounts)
      .def_readonly("all", &PointCounts::all, "points of the cloud")
      .def_readonly("invalid", &PointCounts::invalid, doc::model::PointCounts_invalid)
      .def_readonly("behind_camera", &PointCounts::behind_camera, doc::model::PointCounts_behind_camera)
      .def_readonly("outside_image", &PointCounts::outside_image, doc::model::PointCounts_outside_image)
      .def_readonly("below_support", &PointCounts::below_support, doc::model::PointCounts_below_support)
      .def_readonly("cropped", &PointCounts::cropped, doc::model::PointCounts_cropped)
      .def_readonly("on_support", &PointCounts::on_support, doc::model::PointCounts_on_support)
      .def_readonly("on_tubes", &PointCounts::on_tubes, doc::model::PointCounts_on_tubes)
      .def_readonly("near_support", &PointCounts::near_support, doc::model::PointCounts_near_support)
      .def_readonly("unexplained", &PointCounts::unexplained, doc::model::PointCounts_unexplained);
  py::class_<Finding>(module, "Finding", doc::model::Finding)
      .def_property_readonly(
          "is_error", [](const Finding& finding) { return finding.severity == Finding::Severity::error; },
          doc::model::Finding_Severity_error)
      .def_readonly("code", &Finding::code, doc::model::Finding_code)
      .def_readonly("message", &Finding::message, doc::model::Finding_message);
  py::class_<Step>(module, "Step", doc::model::Step)
      .def_readonly("name", &Step::name, doc::model::Step_name)
      .def_readonly("seconds", &Step::seconds, doc::model::Step_seconds)
      .def_readonly("count", &Step::count, doc::model::Step_count)
      .def_readonly("of", &Step::of, doc::model::Step_of);
}

}  // namespace

void bind_model(py::module_& module) {
  bind_settings(module);
  bind_evidence(module);
  py::class_<Model>(module, "Model", doc::model::Model)
      .def_readonly("tubes", &Model::tubes, doc::model::Model_tubes)
      .def_property_readonly(
          "labels", [](const py::object& self) { return view(self.cast<Model&>().labels, self); },
          doc::model::Model_labels)
      .def_property_readonly(
          "filtered", [](const py::object& self) { return view(self.cast<Model&>().filtered, self); },
          doc::model::Model_filtered)
      .def_readonly("steps", &Model::steps, doc::model::Model_steps)
      .def_readonly("evidence", &Model::evidence, doc::model::Model_evidence)
      .def_readonly("foreign_radii", &Model::foreign_radii, doc::model::Model_foreign_radii)
      .def_readonly("estimated_lengths", &Model::estimated_lengths, doc::model::Model_estimated_lengths)
      .def_readonly("pieces_left_out", &Model::pieces_left_out, doc::model::Model_pieces_left_out)
      .def_readonly("counts", &Model::counts, doc::model::PointCounts)
      .def_readonly("findings", &Model::findings, doc::model::Model_findings)
      .def_property_readonly("is_refused", &Model::is_refused, doc::model::Model_is_refused)
      .def("__repr__", [](const Model& model) {
        return fmt::format("<Model of {}: {}, {}>", counted(model.labels.size(), "point"),
                           counted(model.tubes.size(), "tube"), counted(model.findings.size(), "finding"));
      });
  module.def(
      "model_tubes",
      [](const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings) {
        return without_gil([&] { return model_tubes(cloud, known, settings, ctrl_c_taker()); });
      },
      py::arg("cloud"), py::arg("known"), py::arg_v("settings", ModelSettings{}, "ModelSettings()"),
      also(doc::model::model_tubes, "Ctrl-C raises KeyboardInterrupt between two steps of the method.")
          .c_str());
  module.def("tubes_json", &tubes_json, py::arg("model"), doc::model::tubes_json);
}

}  // namespace tanglebin::python
