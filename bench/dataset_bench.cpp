// Generates the paper's dataset, recipes/paper.toml, like `tanglebin generate`. Reports the wall-clock time,
// each stage's share of the workers' time, and the load of the processors. The sum of the paper's Table 1
// times 20 scenes is 7,799 s. To see the gain from a second worker, run the same part with one and with two:
// build/bench_dataset --benchmark_filter='jobs:2/cases:20'

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double paper_seconds = 7799;

double processor_seconds_of_workers() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// A processor's activity since the machine started, in ticks (proc(5)).
struct Ticks {
  double busy = 0;
  double all = 0;
};

std::vector<Ticks> processors() {
  std::vector<Ticks> result;
  std::ifstream stat("/proc/stat");
  std::string name;
  while (stat >> name && name.starts_with("cpu")) {
    Ticks ticks;
    constexpr int columns = 10;
    constexpr int user_steal_end = 8;  // user time already includes guest time
    for (int column = 0; column < columns; ++column) {
      double value = 0;
      stat >> value;
      if (column >= user_steal_end) continue;
      ticks.all += value;
      if (column != 3 && column != 4) ticks.busy += value;  // idle, and waiting for the disk
    }
    if (name != "cpu") result.push_back(ticks);
  }
  return result;
}

void PaperDataset(benchmark::State& state) {
  const int jobs = static_cast<int>(state.range(0));
  Recipe recipe = read_recipe("recipes/paper.toml");
  for (SetRecipe& set : recipe.sets) set.cases = static_cast<int>(state.range(1));
  const std::filesystem::path directory = std::filesystem::temp_directory_path() / "tanglebin-bench-dataset";
  std::filesystem::remove_all(directory);

  for ([[maybe_unused]] const auto iteration : state) {
    const double worked_before = processor_seconds_of_workers();
    const std::vector<Ticks> before = processors();
    const Clock::time_point start = Clock::now();
    const FillSummary summary = generate_dataset(recipe, cases(recipe), directory, jobs);
    const double wall = std::chrono::duration<double>(Clock::now() - start).count();
    const std::vector<Ticks> after = processors();

    StageTimes sum;
    double peak = 0;
    const Catalogue catalogue(directory);
    for (const CaseId& id : catalogue.cases()) {
      const TimesRecord times = catalogue.times(id).value();
      sum.generate += times.times.generate;
      sum.settle += times.times.settle;
      sum.scan += times.times.scan;
      sum.write += times.times.write;
      peak = std::max(peak, times.peak_memory);
    }
    const double worked = sum.generate + sum.settle + sum.scan + sum.write;
    const double worker_cpu = processor_seconds_of_workers() - worked_before;
    state.counters["cases"] = static_cast<double>(summary.progress.made);
    state.counters["wall_s"] = wall;
    state.counters["times_paper"] = paper_seconds / wall * static_cast<double>(summary.progress.made) / 640;
    state.counters["generate_share"] = sum.generate / worked;
    state.counters["settle_share"] = sum.settle / worked;
    state.counters["scan_share"] = sum.scan / worked;
    state.counters["write_share"] = sum.write / worked;
    state.counters["worker_at_work"] = worked / (wall * jobs);
    state.counters["worker_cpu_s"] = worker_cpu;
    state.counters["worker_cpu_share"] = worker_cpu / (wall * jobs);
    for (std::size_t i = 0; i < before.size(); ++i) {
      state.counters["cpu" + std::to_string(i) + "_busy"] =
          (after[i].busy - before[i].busy) / (after[i].all - before[i].all);
    }
    state.counters["peak_MiB"] = peak;
  }
  std::filesystem::remove_all(directory);
}

BENCHMARK(PaperDataset)
    ->ArgNames({"jobs", "cases"})
    ->Args({1, 20})
    ->Args({2, 20})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace tanglebin
