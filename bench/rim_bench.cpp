// A bin that is not where the scene has it: of how many clouds `model` says so, by how far it is off. Heaps
// of 1, 5 and 20 tubes in the paper's bin and in a smaller one with thin walls, seen by six scanners.
// Counters: clouds; with the warning `bin` (warned).
//
//     build/bench_rim

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/paper_sets.hpp"
#include "tanglebin/base/constants.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

struct View {
  std::string camera;
  double tilt;  // rad, against the vertical
  Sensor sensor;
};

std::vector<View> views() {
  return {{"paper", 0, {}},
          {"paper", 0, {.sigma = 0.001}},
          {"paper", 45 * degree, {}},
          {"zivid-one-plus-l", 0, sensor_preset("zivid-one-plus-l")},
          {"zivid-one-plus-l", 30 * degree, sensor_preset("zivid-one-plus-l")},
          {"kinect-v1", 0, sensor_preset("kinect-v1")}};
}

// That of the preset, turned about the middle of the bin's floor.
Camera camera_of(const View& view) {
  Camera camera = camera_preset(view.camera);
  camera.pose = Eigen::AngleAxisd(view.tilt, Eigen::Vector3d::UnitX()) * camera.pose;
  return camera;
}

std::vector<Recipe> recipes() {
  Recipe paper = paper_set("rim", 30);
  paper.seed = 7732;
  Recipe small = paper;
  small.bin = {.length = 0.4, .width = 0.3, .height = 0.15, .wall = 0.005};
  small.sets[0].kinds[0].radius = 0.008;
  small.sets[0].kinds[0].segments[0].length = 0.3;
  small.sets[0].kinds[0].segments[0].cylinder_length_min = 0.01;
  return {paper, small};
}

/// A cloud, and what is known of its scene.
struct Seen {
  PointCloud cloud;
  KnownScene scene;
};

Seen seen_by(const View& view, const Recipe& recipe, const SimulatedScene& heap) {
  const Camera camera = camera_of(view);
  const SegmentSpec& segment = recipe.sets[0].kinds[0].segments[0];
  KnownScene scene{.support = {.bin = recipe.bin}, .camera = camera};
  scene.kinds = {{.radius = recipe.sets[0].kinds[0].radius,
                  .segments = {{1, 2, segment.length}},
                  .length_min = segment.length}};
  return {cloud_from_scan(scan(heap.tubes, recipe.bin, camera, view.sensor, heap.seed),
                          CloudOf::tubes_and_bin, static_cast<int>(heap.tubes.size())),
          scene};
}

const std::vector<Seen>& clouds() {
  static const std::vector<Seen> all = [] {
    constexpr int heaps = 3;
    std::vector<Seen> seen;
    for (const Recipe& recipe : recipes()) {
      for (const int tubes : {1, 5, 20}) {
        for (int number = 1; number <= heaps; ++number) {
          const SimulatedScene heap = simulate(recipe, {"rim", tubes, number});
          for (const View& view : views()) seen.push_back(seen_by(view, recipe, heap));
        }
      }
    }
    return seen;
  }();
  return all;
}

bool is_warned(const PointCloud& cloud, const KnownScene& scene) {
  return std::ranges::any_of(model_tubes(cloud, scene).findings,
                             [](const Finding& finding) { return finding.code == "bin"; });
}

// `off` is the bin's true pose in the frame in which the scene has it.
void count_warnings(benchmark::State& state, const Eigen::Isometry3d& off) {
  double warned = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (const auto& [cloud, scene] : clouds()) {
      KnownScene told = scene;
      told.support.pose = off.inverse(Eigen::Isometry);
      if (is_warned(cloud, told)) ++warned;
    }
  }
  state.counters["clouds"] = static_cast<double>(clouds().size());
  state.counters["warned"] = warned;
}

// All is tilted in the world frame, as on a slope, and told as it is.
void count_false_warnings(benchmark::State& state, const Eigen::Isometry3d& tilt) {
  double warned = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (auto [cloud, scene] : clouds()) {
      for (Eigen::Vector3f& point : cloud.points) point = (tilt * point.cast<double>()).cast<float>();
      scene.support.pose = tilt * scene.support.pose;
      scene.camera.pose = tilt * scene.camera.pose;
      if (is_warned(cloud, scene)) ++warned;
    }
  }
  state.counters["clouds"] = static_cast<double>(clouds().size());
  state.counters["warned"] = warned;
}

Eigen::Isometry3d moved(double x, double y) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0));
}

Eigen::Isometry3d turned(double angle_deg, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle_deg * degree, axis));
}

bool register_all() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  struct Error {
    std::string name;
    Eigen::Isometry3d off;
  };
  const std::vector<Error> errors = {{"in_its_place", moved(0, 0)},          {"3mm_along_x", moved(0.003, 0)},
                                     {"5mm_along_x", moved(0.005, 0)},       {"7mm_along_y", moved(0, 0.007)},
                                     {"10mm_along_both", moved(0.01, 0.01)}, {"1deg_about_z", turned(1, z)},
                                     {"2deg_about_z", turned(2, z)},         {"2deg_about_x", turned(2, x)}};
  for (const auto& [name, off] : errors)
    benchmark::RegisterBenchmark(name.c_str(), count_warnings, off)->Iterations(1);
  benchmark::RegisterBenchmark("on_a_slope_of_10deg", count_false_warnings,
                               turned(10, Eigen::Vector3d(1, 2, 0).normalized()))
      ->Iterations(1);
  return true;
}

[[maybe_unused]] const bool is_registered = register_all();

}  // namespace
}  // namespace tanglebin
