// What each step of modelling costs, by number of tubes and downsampling ratio (percent), set A, one core.
// paper_s is the paper's Table 2 (i7-8750H), of_paper our whole time as a share of it.

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "paper_sets.hpp"
#include "tanglebin/dataset/simulate.hpp"
#include "tanglebin/model/model.hpp"
#include "tanglebin/report/published_figures.hpp"

namespace tanglebin {
namespace {

constexpr int cases_timed = 10;

const std::vector<PointCloud>& clouds_of(int tubes) {
  static std::map<int, std::vector<PointCloud>> made;
  std::vector<PointCloud>& clouds = made[tubes];
  const Recipe recipe = paper_set("A", 30);
  for (int number = static_cast<int>(clouds.size()) + 1; number <= cases_timed; ++number) {
    clouds.push_back(
        cloud_from_scan(simulate(recipe, {"A", tubes, number}).scan, CloudOf::tubes_and_bin, tubes));
  }
  return clouds;
}

void PaperMethod(benchmark::State& state) {
  const int tubes = static_cast<int>(state.range(0));
  const double ratio = static_cast<double>(state.range(1)) / 100;
  const Recipe recipe = paper_set("A", 30);
  const KnownScene known{.bin = recipe.bin, .camera = recipe.camera};
  const std::vector<PointCloud>& clouds = clouds_of(tubes);
  std::map<std::string, double> seconds;
  double total = 0;
  std::size_t next = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    const Model model = model_tubes(clouds[next++], known, Method::paper, ratio, 1, "cloud");
    for (const Step& step : model.steps) {
      seconds[step.name + "_s"] += step.seconds / cases_timed;
      total += step.seconds / cases_timed;
    }
  }
  for (const auto& [name, value] : seconds) state.counters[name] = value;
  const double published = published_modelling_time("A", tubes, ratio).value();
  state.counters["paper_s"] = published;
  state.counters["of_paper"] = total / published;
}

BENCHMARK(PaperMethod)
    ->ArgsProduct({{1, 5, 10, 15, 20}, {10, 50, 100}})
    ->Iterations(cases_timed)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tanglebin
