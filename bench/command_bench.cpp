// What a command of `experiment` costs beside its own time: ten tubes of the paper's set A at a ratio of
// `percent`. The command copies labels that exist (NumPy). Its own time is that of the same command alone,
// and choosing the points (crop, downsampling) what every method needs; each is measured right after the run.
// The overhead is the rest: to write the cloud, start the command, see to its end, and read the labels.
// Medians.

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/paper_sets.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/experiment/given_cloud.hpp"
#include "tanglebin/experiment/modelled.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

Recipe ten_tubes() {
  Recipe recipe = paper_set("A", 30);
  recipe.sets[0].tubes = {10};
  recipe.sets[0].cases = 1;
  return recipe;
}

/// A case on disk, and a command that copies the labels of the points that it gets.
class CaseAndCommand {
public:
  CaseAndCommand(fs::path directory, double ratio)
      : directory_(std::move(directory)), run_{"copy", {"A", 10, 1}, ratio} {
    fs::remove_all(directory_);
    fs::create_directories(directory_ / "scratch");
    const Recipe recipe = ten_tubes();
    generate_dataset(recipe, {run_.scene}, directory_ / "dataset", 1);
    data_ = read_case(read_dataset(directory_ / "dataset"), run_.scene);
    known_ = known_scene(recipe, run_.scene);
    write_labels();
    const std::string copy = fmt::format("/bin/sh -c 'cp {} \"$0\"' {{out.npy}} {{cloud}}", labels_.string());
    copy_ = command_of(copy, directory_);
  }
  ~CaseAndCommand() { fs::remove_all(directory_); }
  CaseAndCommand(const CaseAndCommand&) = delete;
  CaseAndCommand& operator=(const CaseAndCommand&) = delete;

  SeenPoints seen() const {
    return seen_points(data_.cloud, known_, run_.ratio, model_seed(settings_, run_.scene));
  }

  void model() const {
    const Modelled modelled =
        model_by({"copy", copy_}, known_, data_, run_, settings_, directory_ / "scratch");
    if (modelled.model.labels.size() != data_.cloud.points.size()) throw std::runtime_error("no labels");
  }

  void command_alone() const {
    std::vector<std::string> words = copy_.words;
    words[3] = (directory_ / "copied.npy").string();
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    int status = 0;
    if (posix_spawn(&process, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) != 0 ||
        waitpid(process, &status, 0) != process || status != 0)
      throw std::runtime_error("the command has failed");
  }

private:
  void write_labels() const {
    const std::vector<std::size_t> points = seen().given;
    std::string header =
        fmt::format("{{'descr': '<i4', 'fortran_order': False, 'shape': ({},), }}", points.size());
    header.resize(117, ' ');
    std::ofstream file(labels_, std::ios::binary);
    file << "\x93NUMPY\x01" << '\0' << 'v' << '\0' << header << '\n';  // v: 118, the header's length
    for (const std::size_t point : points)
      file.write(reinterpret_cast<const char*>(&data_.cloud.labels[point]), sizeof(std::int32_t));
  }

  fs::path directory_;
  fs::path labels_ = directory_ / "labels.npy";
  RunId run_;
  ExperimentSettings settings_{};
  CaseData data_{};
  KnownScene known_{};
  Command copy_{};
};

template <typename Call>
double milliseconds_of(const Call& call) {
  const Clock::time_point start = Clock::now();
  call();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void command(benchmark::State& state) {
  const CaseAndCommand example(
      fs::temp_directory_path() / fmt::format("tanglebin-bench-command-{}", getpid()),
      static_cast<double>(state.range(0)) / 100);
  std::vector<double> own;
  std::vector<double> choice;
  std::vector<double> overhead;
  for ([[maybe_unused]] const auto iteration : state) {
    const double run = milliseconds_of([&] { example.model(); });
    own.push_back(milliseconds_of([&] { example.command_alone(); }));
    choice.push_back(milliseconds_of([&] { benchmark::DoNotOptimize(example.seen()); }));
    overhead.push_back(run - own.back() - choice.back());
  }
  state.counters["points"] = static_cast<double>(example.seen().given.size());
  state.counters["own_ms"] = median(own);
  state.counters["choice_ms"] = median(choice);
  state.counters["overhead_ms"] = median(overhead);
}
BENCHMARK(command)->ArgName("percent")->Arg(10)->Arg(30)->Arg(100)->Iterations(200)->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace tanglebin
