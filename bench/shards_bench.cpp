// Many shards in one directory: what the journals, locks and the manifest cost. A case is one small file, so
// nearly all of the time is that of the runs and their store. As many shards at a time as `at_a_time`; 1: one
// after the other. build/bench_shards compares it with one run of the same cases.

#include <benchmark/benchmark.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/runs/shard.hpp"

namespace tanglebin {
namespace {

constexpr int cases_of_a_shard = 10;

MadeCase write_name(const CaseId& id, const CaseWriter& writer) {
  const std::string path = file_of(id, "plys", "ply");
  return {{id, 1, 0, 0, 0, {}, {writer.write(path, path)}}, {id, {}, 0}};
}

Recipe recipe_of(int cases) {
  std::istringstream text("[[set]]\nname = \"A\"\ntubes = [1]\ncases = " + std::to_string(cases) +
                          "\n[set.tube]\nradius = 0.0125\nmass = 0.5\nlength = 0.5\nbend_max_deg = 30\n");
  return read_recipe(text, "shards");
}

void run_shard(const Recipe& recipe, const std::filesystem::path& directory, const Shard& shard) {
  fill_dataset(
      {.recipe = recipe, .wanted = part_of(shard, cases(recipe)), .directory = directory, .shard = shard},
      write_name, {});
}

void wait_for_one() {
  int status = 0;
  wait(&status);
  if (status != 0) throw std::runtime_error("a shard has failed");
}

void run_shards(const Recipe& recipe, const std::filesystem::path& directory, int count, int at_a_time) {
  int running = 0;
  for (int index = 1; index <= count; ++index) {
    if (fork() == 0) {
      run_shard(recipe, directory, {index, count});
      _exit(0);
    }
    if (++running < at_a_time) continue;
    wait_for_one();
    --running;
  }
  for (; running > 0; --running) wait_for_one();
}

void Shards(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const int at_a_time = static_cast<int>(state.range(1));
  const Recipe recipe = recipe_of(static_cast<int>(state.range(2)));
  const std::filesystem::path directory = std::filesystem::temp_directory_path() / "tanglebin-bench-shards";
  for ([[maybe_unused]] const auto iteration : state) {
    std::filesystem::remove_all(directory);
    run_shards(recipe, directory, count, at_a_time);
  }
  const std::optional<DatasetSummary> summary = read_dataset_summary(directory);
  if (!summary || !summary->is_complete()) throw std::runtime_error("the dataset is not complete");
  std::filesystem::remove_all(directory);
}

BENCHMARK(Shards)
    ->ArgNames({"shards", "at_a_time", "cases"})
    ->Args({1, 1, 1000 * cases_of_a_shard})
    ->Args({1000, 1, 1000 * cases_of_a_shard})
    ->Args({1000, 16, 1000 * cases_of_a_shard})
    ->Args({1000, 1000, 1000 * cases_of_a_shard})
    ->Args({100, 1, 100 * cases_of_a_shard})
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace tanglebin
