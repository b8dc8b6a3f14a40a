// The cost of a case, from the recipe to files on disk, with each stage's share. For comparison, the paper's
// Table 1 (set A, i7-8750H): 3.13 s, 8.25 s, 14.20 s and 28.10 s for 1, 5, 10 and 20 tubes.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "bench/paper_sets.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int cases_timed = 20;  // the result is their median

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void generate_cases(benchmark::State& state, const Recipe& recipe) {
  const std::filesystem::path directory = std::filesystem::temp_directory_path() / "tanglebin-bench";
  const int tubes = static_cast<int>(state.range(0));
  std::vector<double> seconds;
  StageTimes sum;
  std::size_t rejected = 0;
  int number = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    const Clock::time_point start = Clock::now();
    const CaseId id{recipe.sets[0].name, tubes, ++number};
    const SimulatedScene scene = simulate(recipe, id);
    const Clock::time_point simulated = Clock::now();
    for (const CaseFile& file : case_files(recipe, id, scene)) {
      make_directories((directory / file.path).parent_path());
      write_file(directory / file.path, file.bytes);
    }
    seconds.push_back(seconds_since(start));
    sum.generate += scene.times.generate;
    sum.settle += scene.times.settle;
    sum.scan += scene.times.scan;
    sum.write += seconds_since(simulated);
    rejected += scene.rejections.size();
  }
  std::filesystem::remove_all(directory);

  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto mean = [&](double total) {
    return benchmark::Counter(total / static_cast<double>(seconds.size()));
  };
  state.counters["median_s"] = median(seconds);
  state.counters["generate_s"] = mean(sum.generate);
  state.counters["settle_s"] = mean(sum.settle);
  state.counters["scan_s"] = mean(sum.scan);
  state.counters["write_s"] = mean(sum.write);
  state.counters["rejected"] = static_cast<double>(rejected);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024;
}

void SetA(benchmark::State& state) {
  generate_cases(state, paper_set("A", 30));
}
void SetB(benchmark::State& state) {
  generate_cases(state, paper_set("B", 45));
}

BENCHMARK(SetA)->Arg(1)->Arg(5)->Arg(10)->Arg(20)->Iterations(cases_timed)->Unit(benchmark::kMillisecond);
BENCHMARK(SetB)->Arg(10)->Arg(20)->Iterations(cases_timed)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tanglebin
