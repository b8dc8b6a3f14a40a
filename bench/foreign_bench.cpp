// Foreign tubes: heaps in the paper's bin in which every fourth tube has another radius than the one that is
// told; with a margin, the bin is told to 5 mm. Counters, over all heaps: the modelled tubes of which most
// points are of a foreign one (foreign), how many of these are sure, a confidence of at least 0.9 (sure); how
// many tubes were left out (left_out); how many tubes of the known radius there are (told), and of how many
// more than half of the points are on a tube of their own (found) or on no tube at all (lost). The time is
// that of modelling one heap.
//
//     build/bench_foreign

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/paper_sets.hpp"
#include "bench/row.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

/// Tubes of a known radius, and those of other radii that may be among them.
struct Mixture {
  std::string name;
  double known;                 // m
  double length;                // m, of all of them
  std::vector<double> foreign;  // m, one of them in each heap
};

const std::vector<Mixture>& mixtures() {
  static const std::vector<Mixture> all = {{"9mm", 0.009, 0.6, {0.003, 0.004, 0.006, 0.012, 0.015}},
                                           {"12.5mm", 0.0125, 0.5, {0.006, 0.008}}};
  return all;
}

// Three tubes of the known radius, then a foreign one, and so on.
Recipe recipe_of(const Mixture& mixture, double foreign) {
  Recipe recipe = paper_set("foreign", 30);
  recipe.seed = 7731;
  TubeSpec known = recipe.sets[0].kinds[0];
  known.radius = mixture.known;
  known.mass = 0;
  known.density = 1100;
  known.segments[0].length = mixture.length;
  TubeSpec other = known;
  other.radius = foreign;
  recipe.sets[0].kinds = {known, known, known, other};
  return recipe;
}

std::vector<SimulatedScene> heaps_of(const Mixture& mixture) {
  constexpr int heaps = 3;
  std::vector<SimulatedScene> scenes;
  for (const double foreign : mixture.foreign) {
    for (const int tubes : {4, 12}) {
      for (int number = 1; number <= heaps; ++number)
        scenes.push_back(simulate(recipe_of(mixture, foreign), {"foreign", tubes, number}));
    }
  }
  return scenes;
}

KnownScene known_of(const Mixture& mixture, const std::string& camera, double margin) {
  KnownScene known{.camera = camera_preset(camera)};
  known.support.margin = margin;
  known.kinds = {
      {.radius = mixture.known, .segments = {{1, 2, mixture.length}}, .length_min = mixture.length}};
  return known;
}

/// Sums over the heaps.
struct Counts {
  double foreign = 0;
  double sure = 0;
  double left_out = 0;
  double told = 0;
  double found = 0;
  double lost = 0;
};

/// How many points each true tube has on each modelled one.
using Shared = std::map<int, std::map<int, int>>;

Shared shared_points(const std::vector<std::int32_t>& from, const std::vector<std::int32_t>& to) {
  Shared shared;
  for (std::size_t i = 0; i < from.size(); ++i) ++shared[from[i]][to[i]];
  return shared;
}

// The label that most points have.
int most_of(const std::map<int, int>& counts) {
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

void count_foreign(const PointCloud& cloud, const Model& model, const std::set<int>& foreign,
                   Counts& counts) {
  for (const auto& [tube, of] : shared_points(model.labels, cloud.labels)) {
    if (tube <= 0 || !foreign.contains(most_of(of))) continue;
    ++counts.foreign;
    if (model.evidence[static_cast<std::size_t>(tube) - 1].confidence >= 0.9) ++counts.sure;
  }
  counts.left_out += static_cast<double>(model.foreign_radii.size());
}

void count_found(const PointCloud& cloud, const Model& model, const std::set<int>& foreign, Counts& counts) {
  std::set<int> taken;
  for (const auto& [tube, on] : shared_points(cloud.labels, model.labels)) {
    if (tube <= 0 || foreign.contains(tube)) continue;
    ++counts.told;
    int points = 0;
    int on_none = 0;
    for (const auto& [label, count] : on) {
      points += count;
      if (label <= bin_label) on_none += count;
    }
    if (2 * on_none > points) ++counts.lost;
    const int most = most_of(on);
    if (most > 0 && 2 * on.at(most) > points && taken.insert(most).second) ++counts.found;
  }
}

void model_heaps(benchmark::State& state, const Mixture& mixture, const std::string& camera,
                 const Sensor& sensor, double margin) {
  const KnownScene known = known_of(mixture, camera, margin);
  Counts counts;
  double seconds = 0;
  double heaps = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (const SimulatedScene& scene : heaps_of(mixture)) {
      const PointCloud cloud =
          cloud_from_scan(scan(scene.tubes, known.support.bin, known.camera, sensor, scene.seed),
                          CloudOf::tubes_and_bin, static_cast<int>(scene.tubes.size()));
      std::set<int> foreign;
      for (const Tube& tube : scene.tubes) {
        if (tube.radius != mixture.known) foreign.insert(tube.id);
      }
      const auto start = std::chrono::steady_clock::now();
      const Model model = model_tubes(cloud, known);
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      count_foreign(cloud, model, foreign, counts);
      count_found(cloud, model, foreign, counts);
      ++heaps;
    }
  }
  state.SetIterationTime(seconds / heaps);
  state.counters["foreign"] = counts.foreign;
  state.counters["sure"] = counts.sure;
  state.counters["left_out"] = counts.left_out;
  state.counters["told"] = counts.told;
  state.counters["found"] = counts.found;
  state.counters["lost"] = counts.lost;
}

bool register_all() {
  constexpr double margin = 0.005;
  for (const Mixture& mixture : mixtures()) {
    for (const std::string camera : {"paper", "zivid-one-plus-l", "kinect-v1"}) {
      const Sensor sensor = camera == "paper" ? Sensor{} : sensor_preset(camera);
      const std::string name = mixture.name + "/" + camera;
      add_row(name, model_heaps, mixture, camera, sensor, 0)->UseManualTime();
      add_row(name + "/margin", model_heaps, mixture, camera, sensor, margin)->UseManualTime();
    }
  }
  return true;
}

[[maybe_unused]] const bool is_registered = register_all();

}  // namespace
}  // namespace tanglebin
