#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/geometry/mass_properties.hpp"
#include "tanglebin/settle/settle.hpp"
#include "tanglebin/settle/spawn.hpp"

namespace {

using namespace tanglebin;

constexpr double set_a = std::numbers::pi / 6;  // rad, largest bend
constexpr double set_b = std::numbers::pi / 4;
constexpr int heaps = 8;  // a benchmark settles the heaps of seeds 1 to 8, one per iteration

std::vector<Tube> drawn_tubes(Rng& rng, int count, double bend_max) {
  TubeSpec spec;
  spec.segments.front().bend_max = bend_max;
  std::vector<Tube> tubes;
  for (int id = 1; id <= count; ++id) tubes.push_back(draw_tube(rng, spec, id));
  return tubes;
}

/// One attempt at a heap as in a dataset, valid or not. Arguments: tubes.
void settle_heap(benchmark::State& state, double bend_max, const char* bin_name) {
  const Bin bin = bin_preset(bin_name);
  const SettleSettings settings;
  std::uint64_t seed = 0;
  double simulated = 0;
  double rejected = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Rng rng(++seed);
    std::vector<Tube> tubes = drawn_tubes(rng, static_cast<int>(state.range(0)), bend_max);
    spawn(rng, tubes, bin);
    state.ResumeTiming();
    const Settled heap = settle(tubes, bin, settings, seed);
    simulated += heap.simulated;
    if (!heap.fault.empty()) rejected += 1;
  }
  using benchmark::Counter;
  state.counters["simulated_s"] = Counter(simulated, Counter::kAvgIterations);
  state.counters["s_per_simulated_s"] = Counter(simulated, Counter::kIsRate | Counter::kInvert);
  state.counters["rejected"] = rejected;
}

void spawn_tubes(benchmark::State& state) {
  Rng rng(1);
  const std::vector<Tube> drawn = drawn_tubes(rng, static_cast<int>(state.range(0)), set_b);
  for (auto _ : state) {
    std::vector<Tube> tubes = drawn;
    spawn(rng, tubes, Bin{});
    benchmark::DoNotOptimize(tubes.data());
  }
}

void mass_properties_of_a_tube(benchmark::State& state) {
  Rng rng(1);
  const std::vector<Tube> tubes = drawn_tubes(rng, 100, set_b);
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(mass_properties(tubes[next++ % tubes.size()]));
}

BENCHMARK_CAPTURE(settle_heap, a_paper, set_a, "paper")
    ->Arg(1)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Iterations(heaps)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(settle_heap, b_paper, set_b, "paper")
    ->Arg(1)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Iterations(heaps)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(settle_heap, a_published, set_a, "published")
    ->Arg(60)
    ->Iterations(heaps)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(settle_heap, b_published, set_b, "published")
    ->Arg(60)
    ->Iterations(heaps)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(spawn_tubes)->Arg(1)->Arg(20)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(mass_properties_of_a_tube)->Unit(benchmark::kMicrosecond);

}  // namespace
