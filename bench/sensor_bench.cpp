#include <benchmark/benchmark.h>

#include <vector>

#include "bench/pile.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace {

using namespace tanglebin;

/// A scan of twenty tubes by the Zivid's camera, as a user calls it.
void scan_by(benchmark::State& state, const Sensor& sensor) {
  const Bin bin;
  const std::vector<Tube> tubes = pile(20, bin);
  const Camera camera = camera_preset("zivid-one-plus-l");
  for (auto _ : state) {
    const Scan result = scan(tubes, bin, camera, sensor, 1);
    benchmark::DoNotOptimize(result.pixels.data());
  }
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
