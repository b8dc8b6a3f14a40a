// The radius of tubes from scans of them, from an unknown start: its error, relative, mean and worst of some
// heaps in a bin that suits their size. Counters: mean and worst error, the mean standard error that the
// estimate gives itself, pixels across a tube, and how many scenes gave no estimate (label: the last reason).
//
//     SCENES=5 build/bench_radius

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/paper_sets.hpp"
#include "bench/row.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/model/axis/radius.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

int number_of_scenes() {
  const char* const wanted = std::getenv("SCENES");
  return wanted == nullptr ? 5 : std::atoi(wanted);
}

// Tubes of forty radii. The camera is as near as it would be in practice.
Recipe recipe_of(double radius, const std::string& scanner) {
  Recipe recipe = paper_set("radius", 30);
  recipe.seed = 1802;
  recipe.bin = {.length = 44 * radius, .width = 30 * radius, .height = 16 * radius};
  recipe.camera = camera_preset(scanner);
  recipe.camera.pose.translation().z() = std::clamp(160 * radius, 0.6, 5.0);
  recipe.sensor = sensor_preset(scanner);
  recipe.sensor.working_distance = recipe.camera.pose.translation().z();
  recipe.sets[0].kinds[0].radius = radius;
  recipe.sets[0].kinds[0].segments[0].length = 40 * radius;
  recipe.sets[0].kinds[0].segments[0].cylinder_length_min = 1.6 * radius;
  return recipe;
}

void estimate(benchmark::State& state, const std::string& scanner, Support::Shape support, double radius) {
  const Recipe recipe = recipe_of(radius, scanner);
  const auto tubes = static_cast<int>(state.range(0));
  const KnownScene known{.support = {.shape = support, .bin = recipe.bin}, .camera = recipe.camera};
  double sum = 0;
  double worst = 0;
  double standard_errors = 0;
  double estimated = 0;
  double failed = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    for (int number = 1; number <= number_of_scenes(); ++number) {
      try {
        const PointCloud cloud =
            cloud_from_scan(simulate(recipe, {"radius", tubes, number}).scan, CloudOf::tubes_and_bin, tubes);
        const RadiusEstimate found = estimate_radius(cloud, known);
        const double error = found.radius / radius - 1;
        sum += error;
        worst = std::max(worst, std::abs(error));
        standard_errors += found.standard_error / radius;
        ++estimated;
      } catch (const InputError& error) {
        state.SetLabel(error.what());
        ++failed;
      }
    }
  }
  state.counters["pixels_across"] = 2 * radius * recipe.camera.fx / recipe.camera.pose.translation().z();
  state.counters["failed"] = failed;
  if (estimated == 0) return;
  state.counters["mean_error"] = sum / estimated;
  state.counters["worst_error"] = worst;
  state.counters["standard_error"] = standard_errors / estimated;
}

bool register_all() {
  for (const std::string scanner : {"paper", "gaussian", "zivid-one-plus-l", "kinect-v1"}) {
    for (const auto support : {Support::Shape::bin, Support::Shape::nothing}) {
      for (const double millimetres : {2.0, 4.0, 6.0, 8.0, 12.5, 25.0, 40.0, 60.0}) {
        const std::string name = scanner + "/" + name_of(support) + "/" + std::to_string(millimetres) + "mm";
        add_row(name, estimate, scanner, support, millimetres / 1e3)->Arg(1)->Arg(5)->Arg(20);
      }
    }
  }
  return true;
}

[[maybe_unused]] const bool is_registered = register_all();

}  // namespace
}  // namespace tanglebin
