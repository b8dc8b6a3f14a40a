#include "tanglebin/scene/scene.hpp"

#include <fmt/ranges.h>
#include <pybind11/operators.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "long_work.hpp"
#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/locate/locate.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/scene/camera_file.hpp"
#include "tanglebin/scene/read_measurement.hpp"
#include "tanglebin/scene/read_scene.hpp"
#include "tanglebin/scene/resolve_scene.hpp"
#include "tanglebin/scene/write_scene.hpp"

namespace tanglebin::python {
namespace {

namespace fs = std::filesystem;

std::string scene_text(const Scene& scene) {
  validate(scene);
  return bytes_of([&](std::ostream& out) { write_scene(out, scene); });
}

// What is known: "<Scene: camera, bin, tubes>".
std::string text_of_scene(const Scene& scene) {
  std::vector<std::string> known;
  if (scene.camera.intrinsics) known.emplace_back("camera");
  if (scene.support) known.emplace_back(name_of(scene.support->shape));
  if (!scene.tubes.empty()) known.emplace_back("tubes");
  return fmt::format("<Scene: {}>", known.empty() ? "nothing" : fmt::format("{}", fmt::join(known, ", ")));
}

Scene scene_from(const std::string& text) {
  std::istringstream in(text);
  return read_scene(in, "scene", ".");
}

void bind_scenes(py::module_& module) {
  py::class_<Scene>(module, "Scene", doc::scene::Scene)
      .def(py::init(&scene_from), py::arg("toml") = "",
           "Reads the text of a scene file (docs/formats.md); camera files in it are relative to the current "
           "folder.")
      .def("toml", &scene_text, "The text of a scene file that reads back as the same, number for number.")
      .def_property_readonly("is_empty", &is_empty, doc::scene::is_empty)
      .def("overridden", &overridden, py::arg("more"), doc::scene::overridden)
      .def("__repr__", &text_of_scene)
      .def(py::pickle(&scene_text, &scene_from));
  module.def(
      "read_scene", [](const fs::path& file, std::optional<int> image) { return read_scene(file, image); },
      py::arg("file"), py::arg("image") = py::none(), doc::scene::read_scene);
  module.def(
      "write_scene", [](const fs::path& file, const Scene& scene) { write_file(file, scene_text(scene)); },
      py::arg("file"), py::arg("scene"), doc::scene::write_scene);

  py::class_<SceneCamera>(module, "SceneCamera", doc::scene::SceneCamera)
      .def_readonly("intrinsics", &SceneCamera::intrinsics, doc::scene::SceneCamera_intrinsics)
      .def_property_readonly(
          "pose",
          [](const SceneCamera& camera) {
            return camera.pose ? std::optional(matrix_of(*camera.pose)) : std::nullopt;
          },
          doc::scene::SceneCamera_pose)
      .def_readonly("unit", &SceneCamera::unit, doc::scene::SceneCamera_unit)
      .def_readonly("depth_scale", &SceneCamera::depth_scale, doc::scene::SceneCamera_depth_scale);
  module.def("read_camera_file", &read_camera_file, py::arg("file"), py::arg("image") = py::none(),
             doc::scene::read_camera_file);
}

void bind_measurements(py::module_& module) {
  py::class_<Measurement>(module, "Measurement", doc::scene::Measurement)
      .def_readonly("cloud", &Measurement::cloud, "as the file has it")
      .def_readonly("scene", &Measurement::scene, "what is known about it");
  module.def(
      "read_measurement",
      [](const fs::path& file, const Scene& scene) {
        return without_gil([&] { return read_measurement(file, scene); });
      },
      py::arg("file"), py::arg_v("scene", Scene{}, "Scene()"), doc::scene::read_measurement);
  py::class_<ResolvedScene>(module, "ResolvedScene", doc::scene::ResolvedScene)
      .def_readonly("cloud", &ResolvedScene::cloud, doc::scene::ResolvedScene_cloud)
      .def_readonly("known", &ResolvedScene::known, doc::scene::ResolvedScene_known)
      .def_readonly("notes", &ResolvedScene::notes, doc::scene::ResolvedScene_notes)
      .def("__repr__", [](const ResolvedScene& scene) {
        return fmt::format("<ResolvedScene of {}: {} of tubes, support: {}>",
                           counted(scene.cloud.points.size(), "point"),
                           counted(scene.known.kinds.size(), "kind"), name_of(scene.known.support.shape));
      });
  const auto resolver = [&](const char* name, auto function, const char* text) {
    module.def(
        name,
        [function](const Scene& scene, const PointCloud& cloud) {
          return without_gil([&] { return function(scene, cloud); });
        },
        py::arg("scene"), py::arg("cloud"), text);
  };
  resolver(
      "resolve",
      [](const Scene& scene, const PointCloud& cloud) { return resolve(scene, cloud, ctrl_c_taker()); },
      also(doc::scene::resolve, "Ctrl-C raises KeyboardInterrupt while it estimates a radius.").c_str());
  resolver("resolve_without_tubes", &resolve_without_tubes, doc::scene::resolve_without_tubes);
}

void bind_known_scene(py::module_& module) {
  namespace doc = tanglebin::doc::model;
  py::class_<Segment>(module, "Segment", tanglebin::doc::geometry::Segment)
      .def(py::init([](int from, int to, double length) {
             return Segment{from, to, length};
           }),
           py::arg("from_node") = Segment{}.from, py::arg("to_node") = Segment{}.to,
           py::arg("length") = Segment{}.length)
      .def_readwrite("from_node", &Segment::from, tanglebin::doc::geometry::Segment_from)
      .def_readwrite("to_node", &Segment::to, tanglebin::doc::geometry::Segment_to)
      .def_readwrite("length", &Segment::length, tanglebin::doc::geometry::Segment_length)
      .def(py::self == py::self);
  py::class_<TubeKind> kind(module, "TubeKind", doc::TubeKind);
  kind.def(py::init([](double radius, const SegmentTree& segments, double length_min, bool flat_ends) {
             return TubeKind{radius, segments, length_min, flat_ends};
           }),
           py::arg("radius") = TubeKind{}.radius, py::arg_v("segments", TubeKind{}.segments, "[Segment()]"),
           py::arg("length_min") = 0.0, py::arg("flat_ends") = false)
      .def_readwrite("radius", &TubeKind::radius, doc::TubeKind_radius)
      .def_readwrite("length_min", &TubeKind::length_min, doc::TubeKind_length_min)
      .def_readwrite("flat_ends", &TubeKind::flat_ends, doc::TubeKind_flat_ends)
      .def_property_readonly("length", &TubeKind::length, doc::TubeKind_length);
  def_list(kind, "segments", &TubeKind::segments, doc::TubeKind_segments);
  py::class_<KnownScene> scene(module, "KnownScene", doc::KnownScene);
  scene
      .def(py::init([](const Support& support, const Camera& camera, const std::vector<TubeKind>& kinds) {
             KnownScene known{support, camera, kinds};
             validate(known);
             return known;
           }),
           py::arg("support"), py::arg("camera"), py::arg_v("kinds", KnownScene{}.kinds, "[TubeKind()]"))
      .def_readwrite("support", &KnownScene::support, tanglebin::doc::geometry::Support)
      .def_readwrite("camera", &KnownScene::camera, doc::KnownScene_camera);
  def_list(scene, "kinds", &KnownScene::kinds, doc::KnownScene_kinds);
  module.def(
      "known_scene",
      [](const Recipe& recipe, const CaseId& id) {
        validate(recipe);
        return known_scene(recipe, id);
      },
      py::arg("recipe"), py::arg("id"), tanglebin::doc::experiment::known_scene);
  module.def("scene_of", &scene_of, py::arg("known"), tanglebin::doc::scene::scene_of);
}

void bind_locate(py::module_& module) {
  namespace doc = tanglebin::doc::model;
  py::class_<LocatedPart>(module, "LocatedPart", doc::LocatedPart)
      .def_readonly("name", &LocatedPart::name, doc::LocatedPart_name)
      .def_readonly("points", &LocatedPart::points, doc::LocatedPart_points)
      .def_readonly("noise", &LocatedPart::noise, doc::LocatedPart_noise);
  py::class_<Located>(module, "Located", doc::Located)
      .def_readonly("support", &Located::support, doc::Located_support)
      .def_property_readonly(
          "position_sd", [](const Located& located) { return array_of(located.position_sd); },
          doc::Located_position_sd)
      .def_property_readonly(
          "rotation_sd", [](const Located& located) { return array_of(located.rotation_sd); },
          doc::Located_position_sd)
      .def_readonly("residual", &Located::residual, doc::Located_residual)
      .def_readonly("explained", &Located::explained, doc::Located_explained)
      .def_readonly("contradicted", &Located::contradicted, doc::Located_explained)
      .def_readonly("measured", &Located::measured, doc::Located_measured)
      .def_readonly("is_wall_measured", &Located::is_wall_measured, doc::Located_is_wall_measured)
      .def_readonly("parts", &Located::parts, "the surfaces that were seen");
  module.def(
      "locate",
      [](const PointCloud& cloud, const Support& support, const Camera& camera) {
        return without_gil([&] { return locate(cloud, support, camera); });
      },
      py::arg("cloud"), py::arg("support"), py::arg("camera"), doc::locate);
}

}  // namespace

void bind_scene(py::module_& module) {
  bind_scenes(module);
  bind_known_scene(module);
  bind_measurements(module);
  bind_locate(module);
}

}  // namespace tanglebin::python
