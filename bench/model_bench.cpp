// The cost of each step of modelling, on one core, for each method: set A in the paper's bin by number of
// tubes and downsampling ratio (percent), and many tubes in the published bin. paper_s is from the paper's
// Table 2 (i7-8750H), of_paper is our total time as a fraction of it, and times_faster is the time of the
// paper's method for the same clouds in the same run, divided by ours. PointsAtRandom is the worst that a
// cloud can be: points anywhere in the bin, of which thousands of pieces of tubes are made.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/paper_sets.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/report/published_figures.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

constexpr int cases_timed = 10;

/// The scans to model.
struct Scans {
  KnownScene known;
  std::vector<PointCloud> clouds;
};

// Made on first use.
const Scans& scans_of(const std::string& bin, int tubes) {
  static std::map<std::pair<std::string, int>, Scans> made;
  const auto [entry, is_new] = made.try_emplace({bin, tubes});
  Scans& scans = entry->second;
  if (!is_new) return scans;
  Recipe recipe = paper_set("A", 30);
  recipe.bin = bin_preset(bin);
  scans.known = {.support = {.bin = recipe.bin}, .camera = recipe.camera};
  for (int number = 1; number <= cases_timed; ++number) {
    scans.clouds.push_back(
        cloud_from_scan(simulate(recipe, {"A", tubes, number}).scan, CloudOf::tubes_and_bin, tubes));
  }
  return scans;
}

/// Mean seconds per cloud, by step.
using StepSeconds = std::map<std::string, double>;

StepSeconds step_seconds(const Scans& scans, Method method, double ratio) {
  StepSeconds seconds;
  for (const PointCloud& cloud : scans.clouds) {
    for (const Step& step :
         model_tubes(cloud, scans.known, {.method = method, .ratio = ratio, .seed = 1}).steps) {
      seconds[step.name] += step.seconds / cases_timed;
    }
  }
  return seconds;
}

double sum(const StepSeconds& seconds) {
  double total = 0;
  for (const auto& [step, value] : seconds) total += value;
  return total;
}

double seconds_by_paper(const std::string& bin, int tubes, double ratio) {
  static std::map<std::tuple<std::string, int, double>, double> measured;
  const auto [entry, is_new] = measured.try_emplace({bin, tubes, ratio});
  if (is_new) entry->second = sum(step_seconds(scans_of(bin, tubes), Method::paper, ratio));
  return entry->second;
}

void ModelTubes(benchmark::State& state, Method method, const std::string& bin) {
  const int tubes = static_cast<int>(state.range(0));
  const double ratio = static_cast<double>(state.range(1)) / 100;
  const Scans& scans = scans_of(bin, tubes);
  const double by_paper = seconds_by_paper(bin, tubes, ratio);
  StepSeconds seconds;
  for ([[maybe_unused]] const auto iteration : state) {
    seconds = step_seconds(scans, method, ratio);
    state.SetIterationTime(sum(seconds));
  }
  for (const auto& [step, value] : seconds) state.counters[step + "_ms"] = 1e3 * value;
  if (method != Method::paper) state.counters["times_faster"] = by_paper / sum(seconds);
  if (const auto published = published_modelling_time("A", tubes, ratio); published && bin == "paper") {
    state.counters["paper_s"] = *published;
    state.counters["of_paper"] = sum(seconds) / *published;
  }
}

PointCloud points_at_random(const Bin& bin, std::int64_t size) {
  Rng rng(1);
  const auto between = [&](double low, double high) {
    return static_cast<float>(uniform_real(rng, low, high));
  };
  PointCloud cloud;
  for (std::int64_t i = 0; i < size; ++i) {
    Eigen::Vector3f point;
    point.x() = between(-bin.length / 2, bin.length / 2);
    point.y() = between(-bin.width / 2, bin.width / 2);
    point.z() = between(0, bin.height);
    cloud.points.push_back(point);
  }
  return cloud;
}

void PointsAtRandom(benchmark::State& state) {
  const KnownScene known{.support = {.bin = bin_preset("paper")}, .camera = camera_preset("paper")};
  const PointCloud cloud = points_at_random(known.support.bin, state.range(0));
  for ([[maybe_unused]] const auto iteration : state) {
    const Model model = model_tubes(cloud, known, {});
    state.counters["tubes"] = static_cast<double>(model.tubes.size());
    for (const Step& step : model.steps) state.counters[step.name + "_ms"] = 1e3 * step.seconds;
  }
}

BENCHMARK(PointsAtRandom)->Arg(50'000)->Arg(200'000)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ModelTubes, axis, Method::axis, "paper")
    ->ArgsProduct({{1, 5, 10, 15, 20}, {10, 50, 100}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ModelTubes, axis_published_bin, Method::axis, "published")
    ->ArgsProduct({{20, 40, 60}, {100}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ModelTubes, paper, Method::paper, "paper")
    ->ArgsProduct({{1, 5, 10, 15, 20}, {10, 50, 100}})
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tanglebin
