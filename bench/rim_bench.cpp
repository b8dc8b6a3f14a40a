// A bin that is not where the scene has it: of how many clouds `model` says so, by how far it is off. Heaps
// of 1, 5 and 20 tubes in the paper's bin and in a smaller one with thin walls, seen by six scanners.
// Counters: clouds; with the warning `bin` (warned). There should be no warning in the rows `in_its_place`,
// `on_a_slope` and `not_a_box`. The last is a bin that is not quite the one that is told, which has a margin.
//
//     build/bench_rim

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/not_a_box.hpp"
#include "bench/paper_sets.hpp"
#include "bench/row.hpp"
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

bool is_warned(const Seen& seen) {
  return std::ranges::any_of(model_tubes(seen.cloud, seen.scene).findings,
                             [](const Finding& finding) { return finding.code == "bin"; });
}

/// What is done to a cloud, or to what is known of its scene.
using Change = std::function<void(Seen&)>;

void count_warnings(benchmark::State& state, const Change& change) {
  double warned = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (Seen seen : clouds()) {
      change(seen);
      if (is_warned(seen)) ++warned;
    }
  }
  state.counters["clouds"] = static_cast<double>(clouds().size());
  state.counters["warned"] = warned;
}

// `off` is the bin's true pose in the frame in which the scene has it.
Change beside(const Eigen::Isometry3d& off) {
  return [=](Seen& seen) { seen.scene.support.pose = off.inverse(Eigen::Isometry); };
}

// All is tilted in the world frame, as on a slope, and told as it is.
Change on_slope(const Eigen::Isometry3d& tilt) {
  return [=](Seen& seen) {
    for (Eigen::Vector3f& point : seen.cloud.points) point = (tilt * point.cast<double>()).cast<float>();
    seen.scene.support.pose = tilt * seen.scene.support.pose;
    seen.scene.camera.pose = tilt * seen.scene.camera.pose;
  };
}

// Walls that lean and bulge, and sizes that are told 2 mm wrong; `off` as for beside().
Change not_a_box(const Eigen::Isometry3d& off) {
  return [=](Seen& seen) {
    Support& told = seen.scene.support;
    lean(seen.cloud, told.bin);
    told.bin.length -= 0.002;
    told.bin.width += 0.002;
    told.bin.height -= 0.002;
    told.margin = 0.005;
    told.pose = off.inverse(Eigen::Isometry);
  };
}

Eigen::Isometry3d moved(double x, double y) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0));
}

Eigen::Isometry3d turned(double angle_deg, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle_deg * degree, axis));
}

bool register_all() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d slope = Eigen::Vector3d(1, 2, 0).normalized();
  const std::vector<std::pair<std::string, Change>> rows = {
      {"in_its_place", beside(moved(0, 0))},
      {"3mm_along_x", beside(moved(0.003, 0))},
      {"5mm_along_x", beside(moved(0.005, 0))},
      {"7mm_along_y", beside(moved(0, 0.007))},
      {"10mm_along_both", beside(moved(0.01, 0.01))},
      {"1deg_about_z", beside(turned(1, z))},
      {"2deg_about_z", beside(turned(2, z))},
      {"1deg_about_x", beside(turned(1, x))},
      {"2deg_about_x", beside(turned(2, x))},
      {"2deg_about_y", beside(turned(2, y))},
      {"on_a_slope_of_10deg", on_slope(turned(10, slope))},
      {"not_a_box", not_a_box(moved(0, 0))},
      {"not_a_box_5mm_along_x", not_a_box(moved(0.005, 0))},
      {"not_a_box_10mm_along_both", not_a_box(moved(0.01, 0.01))},
  };
  for (const auto& [name, change] : rows) add_row(name, count_warnings, change);
  return true;
}

[[maybe_unused]] const bool is_registered = register_all();

}  // namespace
}  // namespace tanglebin
