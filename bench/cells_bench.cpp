// Robot cells other than the paper's: how well twenty tubes are modelled in other bins, by other cameras, of
// other sizes, and with less known about the scene. Counters: micro-recall (mean and worst scene) of the
// points that the filter keeps around the true support; how many scenes were refused, which count in neither;
// the largest error of the estimated radius, if it is estimated. The time is that of modelling one scene.
//
//     SCENES=20 build/bench_cells --benchmark_filter=tilt
//
// scripts/cells makes the tables of docs/robustness.md.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "bench/paper_sets.hpp"
#include "bench/row.hpp"
#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/axis/radius.hpp"
#include "tanglebin/model/locate/locate.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/support_frame.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

/// A robot cell, and the tubes in it.
struct Cell {
  std::string name;
  Bin bin{};
  double radius = 0.0125;  // m
  double length = 0.5;     // m
  std::string camera = "paper";
  double distance = 2;     // m, from the middle of the bin's floor
  double camera_tilt = 0;  // rad, against the vertical
  double tilt = 0;         // rad, of bin and tubes in the world frame
  bool is_plane = false;   // the walls are taken away, and the floor has no end
};

std::vector<Cell> cells() {
  const Bin small{.length = 0.3, .width = 0.25, .height = 0.15};
  const Bin large{.length = 1.2, .width = 0.8, .height = 0.4};
  return {
      {.name = "paper"},
      {.name = "bin_0.3m_6mm", .bin = small, .radius = 0.006, .length = 0.25, .distance = 1},
      {.name = "bin_1.2m", .bin = large},
      {.name = "bin_1.2m_25mm_1m", .bin = large, .radius = 0.025, .length = 1},
      {.name = "bin_tilted_10deg", .tilt = 10 * degree},
      {.name = "camera_tilt_15deg", .camera_tilt = 15 * degree},
      {.name = "camera_tilt_30deg", .camera_tilt = 30 * degree},
      {.name = "camera_tilt_45deg", .camera_tilt = 45 * degree},
      {.name = "camera_0.6m_4mm_0.2m", .bin = small, .radius = 0.004, .length = 0.2, .distance = 0.6},
      {.name = "camera_1.2m", .distance = 1.2},
      {.name = "camera_2.5m", .distance = 2.5},
      {.name = "plane", .is_plane = true},
      {.name = "4mm_0.5m_zivid_1.2m", .radius = 0.004, .camera = "zivid-one-plus-l", .distance = 1.2},
      {.name = "8mm_1m", .bin = large, .radius = 0.008, .length = 1},
      {.name = "12.5mm_1.5m", .bin = large, .length = 1.5},
      {.name = "25mm_0.2m", .bin = large, .radius = 0.025, .length = 0.2},
  };
}

Camera camera_of(const Cell& cell) {
  Camera camera = camera_preset(cell.camera);
  const double across = std::sin(cell.camera_tilt);
  const double up = std::cos(cell.camera_tilt);
  const Eigen::Vector3d z(0, across, -up);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  camera.pose.linear() << x, z.cross(x), z;
  camera.pose.translation() = -cell.distance * z;
  return camera;
}

Recipe recipe_of(const Cell& cell) {
  Recipe recipe = paper_set("cell", 30);
  recipe.seed = 1804;
  recipe.bin = cell.bin;
  recipe.camera = camera_of(cell);
  recipe.sets[0].kinds[0].radius = cell.radius;
  recipe.sets[0].kinds[0].segments[0].length = cell.length;
  recipe.sets[0].kinds[0].segments[0].cylinder_length_min = std::min(0.02, cell.length / 25);
  return recipe;
}

/// The tubes at rest, one heap for each scene.
struct Heaps {
  std::string cell;
  std::vector<SimulatedScene> scenes;
};

int number_of_scenes() {
  const char* const wanted = std::getenv("SCENES");
  return wanted == nullptr ? 20 : std::atoi(wanted);
}

// Those of the last cell are kept: benchmarks of a cell follow one another.
const std::vector<SimulatedScene>& heaps_of(const Cell& cell) {
  static Heaps heaps;
  if (heaps.cell == cell.name) return heaps.scenes;
  heaps = {cell.name, {}};
  constexpr int tubes = 20;
  for (int number = 1; number <= number_of_scenes(); ++number)
    heaps.scenes.push_back(simulate(recipe_of(cell), {"cell", tubes, number}));
  return heaps.scenes;
}

/// What the method is told.
enum class Told { all, no_length, short_length, long_length, no_support, no_pose, no_radius };

KnownScene known_of(const Cell& cell, Told told) {
  KnownScene known{.support = {.bin = cell.bin}, .camera = camera_of(cell)};
  if (cell.is_plane) known.support.shape = Support::Shape::plane;
  if (told == Told::no_support) known.support.shape = Support::Shape::nothing;
  known.support.pose = Eigen::AngleAxisd(cell.tilt, Eigen::Vector3d(1, 2, 0).normalized());
  known.camera.pose = known.support.pose * known.camera.pose;
  double length = cell.length;
  if (told == Told::no_length) length = std::numeric_limits<double>::infinity();
  if (told == Told::short_length) length *= 0.9;
  if (told == Told::long_length) length *= 1.1;
  known.kinds = {{.radius = cell.radius, .segments = {{1, 2, length}}}};
  if (told != Told::no_length) known.kinds[0].length_min = length;
  return known;
}

PointCloud cloud_of(const Cell& cell, const SimulatedScene& scene, const Sensor& sensor) {
  const Bin plane{.length = 8, .width = 8, .height = 1e-6};
  PointCloud cloud = cloud_from_scan(
      scan(scene.tubes, cell.is_plane ? plane : cell.bin, camera_of(cell), sensor, scene.seed),
      CloudOf::tubes_and_bin, static_cast<int>(scene.tubes.size()), {.mixed = true});
  const Eigen::Isometry3d pose = known_of(cell, Told::all).support.pose;
  for (Eigen::Vector3f& point : cloud.points) point = (pose * point.cast<double>()).cast<float>();
  return cloud;
}

// The points that are modelled when all is known.
std::vector<std::size_t> points_around_support(const PointCloud& cloud, const KnownScene& known) {
  const Seen seen = in_support_frame(cloud, known);
  return crop(seen.cloud, seen.known.support, {}).kept;
}

double recall_without_mixed(const PointCloud& cloud, const Model& model,
                            const std::vector<std::size_t>& scored) {
  return *score(picked(cloud.labels, scored), picked(model.labels, scored), picked(cloud.mixed, scored))
              .unmixed_recall;
}

// What is not told, found in the cloud.
KnownScene found_in(const PointCloud& cloud, KnownScene known, Told told) {
  if (told == Told::no_radius) known.kinds[0].radius = estimate_radius(cloud, known).radius;
  if (told == Told::no_pose) {
    known.support.pose.setIdentity();
    known.support = locate(cloud, known.support, known.camera).support;
  }
  return known;
}

// The modelled tubes of which most points are on no tube.
double false_tubes(const PointCloud& cloud, const Model& model) {
  std::vector<int> on_tubes(model.tubes.size() + 1);
  for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
    if (model.labels[i] > 0)
      on_tubes[static_cast<std::size_t>(model.labels[i])] += cloud.labels[i] > 0 ? 1 : -1;
  }
  return static_cast<double>(
      std::count_if(on_tubes.begin() + 1, on_tubes.end(), [](int excess) { return excess <= 0; }));
}

void model_cell(benchmark::State& state, const Cell& cell, Sensor sensor, Told told) {
  sensor.working_distance = cell.distance;
  double sum = 0;
  double worst = 1;
  double radius_error = 0;
  double tubes = 0;
  double not_tubes = 0;
  double done = 0;
  double refused = 0;
  double seconds = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (const SimulatedScene& scene : heaps_of(cell)) {
      const PointCloud cloud = cloud_of(cell, scene, sensor);
      const auto start = std::chrono::steady_clock::now();
      try {
        const KnownScene known = found_in(cloud, known_of(cell, told), told);
        const Model model = model_tubes(cloud, known);
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const std::vector<std::size_t> scored = points_around_support(cloud, known_of(cell, Told::all));
        const double recall = recall_without_mixed(cloud, model, scored);
        sum += recall;
        worst = std::min(worst, recall);
        radius_error = std::max(radius_error, std::abs(known.kinds[0].radius / cell.radius - 1));
        tubes += static_cast<double>(model.tubes.size());
        not_tubes += false_tubes(cloud, model);
        ++done;
      } catch (const InputError& error) {
        state.SetLabel(error.what());
        ++refused;
      }
    }
  }
  done = std::max(done, 1.0);
  state.SetIterationTime(seconds / done);
  state.counters["mean"] = sum / done;
  state.counters["worst"] = worst;
  state.counters["tubes"] = tubes / done;
  state.counters["false_tubes"] = not_tubes / done;
  state.counters["refused"] = refused;
  if (told == Told::no_radius) state.counters["radius_error"] = radius_error;
}

struct Telling {
  std::string name;
  Told told;
};

bool register_all() {
  struct NamedSensor {
    std::string name;
    Sensor sensor;
  };
  const std::vector<NamedSensor> sensors = {{"ideal", {}}, {"zivid", sensor_preset("zivid-one-plus-l")}};
  const std::vector<Telling> tellings = {
      {"all", Told::all},
      {"length_unknown", Told::no_length},
      {"length_-10%", Told::short_length},
      {"length_+10%", Told::long_length},
      {"support_located", Told::no_pose},
      {"support_unknown", Told::no_support},
      {"radius_unknown", Told::no_radius},
  };
  for (const Cell& cell : cells()) {
    for (const auto& [sensor_name, sensor] : sensors) {
      for (const auto& [told_name, told] : tellings) {
        const std::string name = cell.name + "/" + sensor_name + "/" + told_name;
        add_row(name, model_cell, cell, sensor, told)->UseManualTime();
      }
    }
  }
  return true;
}

[[maybe_unused]] const bool is_registered = register_all();

}  // namespace
}  // namespace tanglebin
