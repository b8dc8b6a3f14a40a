#include <benchmark/benchmark.h>

#include <ctime>
#include <vector>

#include "bench/pile.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace {

using namespace tanglebin;

/// Twenty tubes in front of the Zivid's camera.
class Scene {
public:
  Scan scan_by(const Sensor& sensor) const { return scan(tubes_, bin_, camera_, sensor, 1); }

private:
  Bin bin_;
  std::vector<Tube> tubes_ = pile(20, bin_);
  Camera camera_ = camera_preset("zivid-one-plus-l");
};

/// Mean processor time of several scans.
double clocks_of_ideal_scan(const Scene& scene) {
  constexpr int scans = 10;
  const std::clock_t start = std::clock();
  for (int i = 0; i < scans; ++i) benchmark::DoNotOptimize(scene.scan_by({}).pixels.data());
  return static_cast<double>(std::clock() - start) / scans;
}

void scan_by(benchmark::State& state, const Sensor& sensor) {
  const Scene scene;
  const double before = clocks_of_ideal_scan(scene);
  const std::clock_t start = std::clock();
  for (auto _ : state) benchmark::DoNotOptimize(scene.scan_by(sensor).pixels.data());
  const auto clocks = static_cast<double>(std::clock() - start);
  const double ideal = (before + clocks_of_ideal_scan(scene)) / 2;
  state.counters["times_ideal"] = clocks / static_cast<double>(state.iterations()) / ideal;
}

const Sensor zivid = sensor_preset("zivid-one-plus-l");

BENCHMARK_CAPTURE(scan_by, ideal, Sensor{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, all_terms, zivid)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, sigma, Sensor{.sigma = 0.0005})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, dropout, Sensor{.dropout = 0.02})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, edges_dropped, Sensor{.edges = Edges::drop})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, edges_mixed, Sensor{.edges = Edges::mix})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, shadows, Sensor{.shadows = true})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, signal, Sensor{.signal = true})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, disparity, Sensor{.disparity_sigma = 0.04})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, trueness, Sensor{.trueness = 0.0003})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scan_by, kinect_noise, Sensor{.kinect_noise = true})->Unit(benchmark::kMillisecond);

}  // namespace
