#include <pybind11/operators.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "images.hpp"
#include "long_work.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/settle/overlap.hpp"
#include "tanglebin/settle/settle.hpp"
#include "tanglebin/settle/spawn.hpp"

namespace tanglebin::python {
namespace {

void bind_drawing(py::module_& module) {
  namespace doc = tanglebin::doc::generate;
  py::class_<Rng>(module, "Rng", "The random generator that tubes are drawn with, 64-bit Mersenne Twister.")
      .def(py::init([](std::uint64_t seed) { return Rng(seed); }), py::arg("seed"))
      .def(
          "__call__", [](Rng& rng) { return std::uint64_t{rng()}; }, "The next 64 random bits.");
  py::class_<SegmentSpec>(module, "SegmentSpec", doc::SegmentSpec)
      .def(py::init([](int from, int to, double length, int cylinders_min, int cylinders_max,
                       double cylinder_length_min, double bend_min, double bend_max) {
             SegmentSpec spec;
             spec.from = from;
             spec.to = to;
             spec.length = length;
             spec.cylinders_min = cylinders_min;
             spec.cylinders_max = cylinders_max;
             spec.cylinder_length_min = cylinder_length_min;
             spec.bend_min = bend_min;
             spec.bend_max = bend_max;
             return spec;
           }),
           py::arg("from_node") = SegmentSpec{}.from, py::arg("to_node") = SegmentSpec{}.to,
           py::arg("length") = SegmentSpec{}.length, py::arg("cylinders_min") = SegmentSpec{}.cylinders_min,
           py::arg("cylinders_max") = SegmentSpec{}.cylinders_max,
           py::arg("cylinder_length_min") = SegmentSpec{}.cylinder_length_min,
           py::arg("bend_min") = SegmentSpec{}.bend_min, py::arg("bend_max") = SegmentSpec{}.bend_max)
      .def_readwrite("from_node", &SegmentSpec::from, tanglebin::doc::geometry::Segment_from)
      .def_readwrite("to_node", &SegmentSpec::to, tanglebin::doc::geometry::Segment_to)
      .def_readwrite("length", &SegmentSpec::length, tanglebin::doc::geometry::Segment_length)
      .def_readwrite("cylinders_min", &SegmentSpec::cylinders_min, doc::SegmentSpec_cylinders_min)
      .def_readwrite("cylinders_max", &SegmentSpec::cylinders_max, doc::SegmentSpec_cylinders_max)
      .def_readwrite("cylinder_length_min", &SegmentSpec::cylinder_length_min,
                     doc::SegmentSpec_cylinder_length_min)
      .def_readwrite("bend_min", &SegmentSpec::bend_min, doc::SegmentSpec_bend_min)
      .def_readwrite("bend_max", &SegmentSpec::bend_max, doc::SegmentSpec_bend_max)
      .def(py::self == py::self);
  py::class_<Piece>(module, "Piece", doc::Piece)
      .def(py::init([](double length, double bend, double bend_radius, double twist) {
             return Piece{length, bend, bend_radius, twist};
           }),
           py::arg("length") = Piece{}.length, py::arg("bend") = Piece{}.bend,
           py::arg("bend_radius") = Piece{}.bend_radius, py::arg("twist") = Piece{}.twist)
      .def_readwrite("length", &Piece::length, doc::Piece_length)
      .def_readwrite("bend", &Piece::bend, doc::Piece_bend)
      .def_readwrite("bend_radius", &Piece::bend_radius, doc::Piece_bend_radius)
      .def_readwrite("twist", &Piece::twist, doc::Piece_twist)
      .def(py::self == py::self);
  py::class_<TubeSpec> described(module, "TubeSpec", doc::TubeSpec);
  described
      .def(py::init([](double radius, double mass, double density, const std::vector<SegmentSpec>& segments,
                       const std::vector<Piece>& pieces, bool flat_ends) {
             const TubeSpec spec{radius, mass, density, segments, pieces, flat_ends};
             validate(spec);
             return spec;
           }),
           py::arg("radius") = TubeSpec{}.radius, py::arg("mass") = TubeSpec{}.mass,
           py::arg("density") = TubeSpec{}.density,
           py::arg_v("segments", TubeSpec{}.segments, "[SegmentSpec()]"),
           py::arg("pieces") = std::vector<Piece>{}, py::arg("flat_ends") = TubeSpec{}.flat_ends)
      .def_readwrite("radius", &TubeSpec::radius, doc::TubeSpec_radius)
      .def_readwrite("mass", &TubeSpec::mass, doc::TubeSpec_mass)
      .def_readwrite("density", &TubeSpec::density, doc::TubeSpec_density)
      .def_readwrite("flat_ends", &TubeSpec::flat_ends, doc::TubeSpec_flat_ends)
      .def(py::self == py::self);
  def_list(described, "segments", &TubeSpec::segments, "of a hose or tree");
  def_list(described, "pieces", &TubeSpec::pieces, "of a bar, in place of segments");
  module.def(
      "draw_tube",
      [](Rng& rng, const TubeSpec& spec, int id) {
        validate(spec);
        return without_gil([&] { return draw_tube(rng, spec, id); });
      },
      py::arg("rng"), py::arg("spec"), py::arg("id"), doc::draw_tube);
}

void bind_settle(py::module_& module) {
  namespace doc = tanglebin::doc::settle;
  py::class_<SettleSettings>(module, "SettleSettings", doc::SettleSettings)
      .def(py::init<>())
      .def_readwrite("gravity", &SettleSettings::gravity, doc::SettleSettings_gravity)
      .def_readwrite("friction", &SettleSettings::friction, doc::SettleSettings_friction)
      .def_readwrite("step", &SettleSettings::step, doc::SettleSettings_step)
      .def_readwrite("iterations", &SettleSettings::iterations, doc::SettleSettings_iterations)
      .def_readwrite("iterations_max", &SettleSettings::iterations_max, doc::SettleSettings_iterations_max)
      .def_readwrite("sor", &SettleSettings::sor, doc::SettleSettings_sor)
      .def_readwrite("erp", &SettleSettings::erp, doc::SettleSettings_erp)
      .def_readwrite("surface_layer", &SettleSettings::surface_layer, doc::SettleSettings_surface_layer)
      .def_readwrite("correction_speed", &SettleSettings::correction_speed,
                     doc::SettleSettings_correction_speed)
      .def_readwrite("calm_speed", &SettleSettings::calm_speed, doc::SettleSettings_calm_speed)
      .def_readwrite("calm_time", &SettleSettings::calm_time, doc::SettleSettings_calm_time)
      .def_readwrite("calm_damping", &SettleSettings::calm_damping, doc::SettleSettings_calm_damping)
      .def_readwrite("rest_speed", &SettleSettings::rest_speed, doc::SettleSettings_rest_speed)
      .def_readwrite("rest_time", &SettleSettings::rest_time, doc::SettleSettings_rest_time)
      .def_readwrite("proof_time", &SettleSettings::proof_time, doc::SettleSettings_proof_time)
      .def_readwrite("proof_motion", &SettleSettings::proof_motion, doc::SettleSettings_proof_motion)
      .def_readwrite("overlap_max", &SettleSettings::overlap_max, doc::SettleSettings_overlap_max)
      .def_readwrite("time_limit", &SettleSettings::time_limit, doc::SettleSettings_time_limit)
      .def(py::self == py::self);
  py::class_<Settled>(module, "Settled", doc::Settled)
      .def_readonly("tubes", &Settled::tubes, doc::Settled_tubes)
      .def_readonly("simulated", &Settled::simulated, doc::Settled_simulated)
      .def_readonly("largest_overlap", &Settled::largest_overlap, doc::Settled_largest_overlap)
      .def_readonly("fault", &Settled::fault, doc::Settled_fault);
  module.def(
      "spawn",
      [](Rng& rng, std::vector<Tube> tubes, const Bin& bin) {
        validate(bin);
        without_gil([&] { spawn(rng, tubes, bin); });
        return tubes;
      },
      py::arg("rng"), py::arg("tubes"), py::arg("bin"), doc::spawn);
  module.def(
      "settle",
      [](const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings, std::uint64_t seed,
         const Progress& progress) {
        validate(bin);
        validate(settings);
        return without_gil([&] {
          const SimulationTurn turn;
          Reporter reporter(progress);
          return settle(tubes, bin, settings, seed,
                        [&](double simulated) { reporter.report(simulated, settings.time_limit); });
        });
      },
      py::arg("tubes"), py::arg_v("bin", Bin{}, "Bin()"),
      py::arg_v("settings", SettleSettings{}, "SettleSettings()"), py::arg("seed") = 0,
      py::arg("progress") = py::none(),
      also(doc::settle,
           "`progress` is called with the time simulated so far and its limit, s. Ctrl-C raises "
           "KeyboardInterrupt. Other simulations in this process wait.")
          .c_str());
  module.def(
      "fault_of_heap",
      [](const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings) {
        validate(bin);
        validate(settings);
        return without_gil([&] {
          const SimulationTurn turn;
          return fault_of_heap(tubes, bin, settings);
        });
      },
      py::arg("tubes"), py::arg_v("bin", Bin{}, "Bin()"),
      py::arg_v("settings", SettleSettings{}, "SettleSettings()"), doc::fault_of_heap);
  module.def("largest_tube_overlap", &largest_tube_overlap, py::arg("tubes"), doc::largest_tube_overlap);
  module.def("largest_bin_overlap", &largest_bin_overlap, py::arg("tubes"), py::arg("bin"),
             doc::largest_bin_overlap);
}

void bind_sensor(py::module_& module) {
  namespace doc = tanglebin::doc::scan;
  py::enum_<Edges>(module, "Edges", doc::Edges)
      .value("keep", Edges::keep, doc::Edges_keep)
      .value("drop", Edges::drop, doc::Edges_drop)
      .value("mix", Edges::mix, doc::Edges_mix);
  py::class_<Sensor>(module, "Sensor", doc::Sensor)
      .def(py::init<>())
      .def_readwrite("sigma", &Sensor::sigma, doc::Sensor_sigma)
      .def_readwrite("column_correlation", &Sensor::column_correlation, doc::Sensor_column_correlation)
      .def_readwrite("dropout", &Sensor::dropout, doc::Sensor_dropout)
      .def_readwrite("edges", &Sensor::edges, doc::Sensor_edges)
      .def_readwrite("footprint", &Sensor::footprint, doc::Sensor_footprint)
      .def_readwrite("sub_rays", &Sensor::sub_rays, doc::Sensor_sub_rays)
      .def_readwrite("edge_jump", &Sensor::edge_jump, doc::Sensor_edge_jump)
      .def_readwrite("shadows", &Sensor::shadows, doc::Sensor_shadows)
      .def_readwrite("baseline", &Sensor::baseline, doc::Sensor_baseline)
      .def_readwrite("working_distance", &Sensor::working_distance, doc::Sensor_working_distance)
      .def_readwrite("signal", &Sensor::signal, doc::Sensor_signal)
      .def_readwrite("snr", &Sensor::snr, doc::Sensor_snr)
      .def_readwrite("snr_min", &Sensor::snr_min, doc::Sensor_snr_min)
      .def_readwrite("snr_max", &Sensor::snr_max, doc::Sensor_snr_max)
      .def_readwrite("albedo_min", &Sensor::albedo_min, doc::Sensor_albedo_min)
      .def_readwrite("albedo_max", &Sensor::albedo_max, doc::Sensor_albedo_min)
      .def_readwrite("gloss_min", &Sensor::gloss_min, doc::Sensor_gloss_min)
      .def_readwrite("gloss_max", &Sensor::gloss_max, doc::Sensor_gloss_min)
      .def_readwrite("shininess", &Sensor::shininess, doc::Sensor_shininess)
      .def_readwrite("bin_albedo", &Sensor::bin_albedo, doc::Sensor_bin_albedo)
      .def_readwrite("bin_gloss", &Sensor::bin_gloss, doc::Sensor_bin_gloss)
      .def_readwrite("disparity_sigma", &Sensor::disparity_sigma, doc::Sensor_disparity_sigma)
      .def_readwrite("trueness", &Sensor::trueness, doc::Sensor_trueness)
      .def_readwrite("trueness_length", &Sensor::trueness_length, doc::Sensor_trueness_length)
      .def_readwrite("kinect_noise", &Sensor::kinect_noise, doc::Sensor_kinect_noise)
      .def_readwrite("quantization", &Sensor::quantization, doc::Sensor_quantization)
      .def_readwrite("fill", &Sensor::fill, doc::Sensor_fill)
      .def_readwrite("median", &Sensor::median, doc::Sensor_median)
      .def(py::self == py::self);
  module.def("sensor_preset", &sensor_preset, py::arg("name"), doc::sensor_preset);
  module.def("is_ideal", &is_ideal, py::arg("sensor"), doc::is_ideal);
}

// A member of the pixels in the scan's window, h x w, in the scan's memory.
template <auto Member>
auto pixel_view() {
  return [](const py::object& self) {
    auto& scan = self.cast<Scan&>();
    const auto row = static_cast<py::ssize_t>(sizeof(Pixel)) * scan.window.width;
    return view(scan.pixels.empty() ? nullptr : &(scan.pixels.front().*Member),
                {scan.window.height, scan.window.width}, {row, sizeof(Pixel)}, self);
  };
}

// The same of a vector: h x w x 3.
template <auto Member>
auto vector_view() {
  return [](const py::object& self) {
    auto& scan = self.cast<Scan&>();
    const auto row = static_cast<py::ssize_t>(sizeof(Pixel)) * scan.window.width;
    return view(scan.pixels.empty() ? nullptr : (scan.pixels.front().*Member).data(),
                {scan.window.height, scan.window.width, 3}, {row, sizeof(Pixel), sizeof(float)}, self);
  };
}

// What a sensor adds to the pixels, which an ideal scanner does not.
template <auto Member>
auto sensor_view() {
  return [](const py::object& self) -> std::optional<py::array> {
    auto& scan = self.cast<Scan&>();
    auto& values = scan.*Member;
    if (values.empty()) return std::nullopt;
    constexpr py::ssize_t size = sizeof(values.front());
    return view(values.data(), {scan.window.height, scan.window.width}, {size * scan.window.width, size},
                self);
  };
}

CloudOf cloud_of(bool with_bin) {
  return with_bin ? CloudOf::tubes_and_bin : CloudOf::tubes;
}

template <typename MakeCloud>
auto cloud_maker(const MakeCloud& make) {
  return [make](const Scan& scan, int tubes, bool with_bin, bool normals, bool intensities, bool mixed) {
    return without_gil([&] { return make(scan, cloud_of(with_bin), tubes, {normals, intensities, mixed}); });
  };
}

template <typename Below>
Scan scanned(const std::vector<Tube>& tubes, const Below& below, const Camera& camera, const Sensor& sensor,
             std::uint64_t scene_seed, const std::string& scanner) {
  validate(below);
  return without_gil([&] { return scan(tubes, below, camera, sensor, scene_seed, scanner); });
}

void bind_scan(py::module_& module) {
  namespace doc = tanglebin::doc::scan;
  py::class_<PixelWindow>(module, "PixelWindow", doc::PixelWindow)
      .def_readonly("left", &PixelWindow::left, "its first column in the image")
      .def_readonly("top", &PixelWindow::top, "its first row in the image")
      .def_readonly("width", &PixelWindow::width, "columns")
      .def_readonly("height", &PixelWindow::height, "rows");
  py::class_<Scan>(module, "Scan", doc::Scan)
      .def_readonly("camera", &Scan::camera, "the camera that took it")
      .def_readonly("window", &Scan::window, doc::PixelWindow)
      .def_property_readonly("depths", pixel_view<&Pixel::depth>(), doc::Pixel_depth)
      .def_property_readonly("ranges", pixel_view<&Pixel::range>(), doc::Pixel_range)
      .def_property_readonly("incidences", pixel_view<&Pixel::incidence>(), doc::Pixel_incidence)
      .def_property_readonly("labels", pixel_view<&Pixel::label>(), "0 = bin, 1..n = tubes, −1 = null")
      .def_property_readonly("points", vector_view<&Pixel::point>(), doc::Pixel_point)
      .def_property_readonly("normals", vector_view<&Pixel::normal>(), doc::Pixel_normal)
      .def_property_readonly("snr", sensor_view<&Scan::snr>(), doc::Scan_snr)
      .def_property_readonly("mixed", sensor_view<&Scan::mixed>(), doc::Scan_mixed);
  const auto bind = [&](auto function) {
    module.def("scan", function, py::arg("tubes"), py::arg("bin"), py::arg("camera"),
               py::arg_v("sensor", Sensor{}, "Sensor()"), py::arg("scene_seed") = 0, py::arg("scanner") = "",
               doc::scan);
  };
  bind(&scanned<Bin>);
  bind(&scanned<Support>);

  const auto bind_cloud = [&](const char* name, auto function, const char* text) {
    module.def(name, cloud_maker(function), py::arg("scan"), py::arg("tubes"), py::arg("with_bin") = false,
               py::arg("normals") = false, py::arg("intensities") = false, py::arg("mixed") = false, text);
  };
  bind_cloud("cloud_from_scan", &cloud_from_scan, doc::cloud_from_scan);
  bind_cloud("organized_cloud_from_scan", &organized_cloud_from_scan, doc::organized_cloud_from_scan);
  module.def(
      "depth_image",
      [](const Scan& scan) { return array_of(without_gil([&] { return depth_image(scan); })); },
      py::arg("scan"), "Depths of the whole image, h x w float32, m; NaN if nothing was measured.");
  module.def(
      "label_image",
      [](const Scan& scan) { return array_of(without_gil([&] { return label_image(scan); })); },
      py::arg("scan"), "Labels of the whole image, h x w int32: 0 = bin, 1..n = tubes, −1 = null.");
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_drawing(module);
  bind_settle(module);
  bind_sensor(module);
  bind_scan(module);
}

}  // namespace tanglebin::python
