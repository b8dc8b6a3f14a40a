#include "tanglebin/simulate/simulate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tanglebin/settle/settle.hpp"
#include "tanglebin/settle/spawn.hpp"

namespace tanglebin {
namespace {

/// Adds its lifetime to a sum.
class Stopwatch {
public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

// Algorithm 1, then the tubes are spawned above the bin.
std::vector<Tube> draw_tubes(Rng& rng, const SetRecipe& set, int count, const Bin& bin) {
  std::vector<Tube> tubes;
  for (int id = 1; id <= count; ++id) tubes.push_back(draw_tube(rng, kind_of(set, id), id));
  spawn(rng, tubes, bin);
  return tubes;
}

std::vector<Scan> scan_with_all(const Recipe& recipe, const std::vector<Tube>& tubes, std::uint64_t seed) {
  std::vector<Scan> scans;
  for (const Scanner& scanner : scanners(recipe)) {
    scans.push_back(scan(tubes, recipe.bin, scanner.camera, scanner.sensor, seed, scanner.name));
  }
  return scans;
}

std::string no_valid_scene(const CaseId& id, const std::vector<Rejection>& rejections) {
  // Faults that differ only in their numbers count as one kind.
  std::map<std::string, int> counts;
  for (const Rejection& rejection : rejections) {
    ++counts[rejection.fault.substr(0, rejection.fault.find_first_of("0123456789"))];
  }
  std::string text = fmt::format("no valid scene of {} tubes in {} attempts:", id.tubes, rejections.size());
  const char* separator = " ";
  for (const auto& [fault, count] : counts) {
    text += fmt::format("{}{} x {}", separator, count, fault);
    separator = ", ";
  }
  return text + "; try fewer tubes, a larger bin or more attempts";
}

// If a tube falls out each time, the tubes do not fit. Other faults, such as a heap that creeps, may be bad
// luck.
bool is_hopeless(const std::vector<Rejection>& rejections, int attempts) {
  constexpr int share = 4;
  return static_cast<int>(rejections.size()) == (attempts + share - 1) / share &&
         std::ranges::all_of(rejections, [](const Rejection& r) { return r.fault == tube_left_the_bin; });
}

}  // namespace

SimulatedScene simulate(const Recipe& recipe, const CaseId& id, const std::function<void()>& before_attempt,
                        const std::function<void(double)>& at_step) {
  const SetRecipe& set = set_named(recipe, id.set);
  StageTimes times;
  std::vector<Rejection> rejections;
  for (int attempt = 1; attempt <= recipe.attempts && !is_hopeless(rejections, recipe.attempts); ++attempt) {
    before_attempt();
    const std::uint64_t seed = attempt_seed(recipe.seed, id.set, id.tubes, id.number, attempt);
    Rng rng(seed);
    const std::vector<Tube> tubes = [&] {
      const Stopwatch watch(times.generate);
      return draw_tubes(rng, set, id.tubes, recipe.bin);
    }();
    Settled heap = [&] {
      const Stopwatch watch(times.settle);
      return settle(tubes, recipe.bin, recipe.settle, rng(), at_step);
    }();
    if (!heap.fault.empty()) {
      rejections.push_back({seed, heap.simulated, heap.fault});
      continue;
    }
    std::vector<Scan> scans = [&] {
      const Stopwatch watch(times.scan);
      return scan_with_all(recipe, heap.tubes, seed);
    }();
    Scan first = std::move(scans.front());
    scans.erase(scans.begin());
    return {std::move(heap.tubes), std::move(first),     std::move(scans),      seed,
            heap.simulated,        heap.largest_overlap, std::move(rejections), times};
  }
  throw InputError({"", 0, name_of(id)}, no_valid_scene(id, rejections));
}

}  // namespace tanglebin
