#pragma once

#include <benchmark/benchmark.h>

#include <string>

namespace tanglebin {

/// Adds a row that is made in one pass, run(state, arguments...), for the sake of its counters.
template <typename Run, typename... Arguments>
benchmark::internal::Benchmark* add_row(const std::string& name, const Run& run,
                                        const Arguments&... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), run, arguments...)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace tanglebin
