#include "tanglebin/dataset/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/recipe/doubts.hpp"

namespace tanglebin {
namespace {

using Clock = std::chrono::steady_clock;

/// What a case took.
struct Effort {
  double seconds = 0;
  double bytes = 0;
};

/// What a case of a set took, by its number of tubes.
using Efforts = std::map<int, Effort>;

Effort between(const Effort& a, const Effort& b, double share) {
  return {a.seconds + share * (b.seconds - a.seconds), a.bytes + share * (b.bytes - a.bytes)};
}

/// Linear between the nearest numbers of tubes. There is at least one.
Effort interpolated(const Efforts& efforts, int tubes) {
  const auto above = efforts.lower_bound(tubes);
  if (above == efforts.end()) return std::prev(above)->second;
  if (above == efforts.begin()) return above->second;
  const auto below = std::prev(above);
  const double share = static_cast<double>(tubes - below->first) / (above->first - below->first);
  return between(below->second, above->second, share);
}

double size_of(const std::vector<CaseFile>& files) {
  double bytes = 0;
  for (const CaseFile& file : files) bytes += static_cast<double>(file.bytes.size());
  return bytes;
}

/// The first case of the fewest, a middle and the largest number of tubes.
std::vector<CaseId> samples(const std::vector<CaseId>& of_set) {
  std::map<int, CaseId> firsts;
  for (const CaseId& id : of_set) firsts.emplace(id.tubes, id);
  const auto middle = std::next(firsts.begin(), static_cast<std::ptrdiff_t>(firsts.size() / 2));
  std::vector<CaseId> ids{firsts.begin()->second, middle->second, firsts.rbegin()->second};
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// A case's recipe with nothing but its set, and that with no other number of tubes.
Recipe of_case_alone(const Recipe& resolved, const CaseId& id) {
  Recipe alone = resolved;
  SetRecipe set = set_named(resolved, id.set);
  set.tubes = {id.tubes};
  set.drawn_tubes.reset();
  alone.sets = {set};
  return alone;
}

/// Makes cases and notes what they take and what is wrong with them.
class Trial {
public:
  Trial(const Recipe& recipe, Clock::duration patience) : recipe_(recipe), patience_(patience) {}

  void estimate(const std::vector<CaseId>& of_set) {
    Efforts efforts;
    for (const CaseId& id : samples(of_set)) efforts.emplace(id.tubes, effort_of(id));
    SetEstimate estimate{.set = of_set.front().set, .cases = of_set.size()};
    for (const CaseId& id : of_set) {
      const Effort effort = interpolated(efforts, id.tubes);
      estimate.seconds += effort.seconds;
      estimate.bytes += effort.bytes;
    }
    result_.sets.push_back(estimate);
  }

  DryRun take() { return std::move(result_); }

private:
  void warn(const std::string& warning) {
    if (std::ranges::find(result_.warnings, warning) == result_.warnings.end())
      result_.warnings.push_back(warning);
  }

  void look(const Scan& scan, const std::string& scanner, const CaseId& id) {
    if (!shows_a_tube(scan))
      warn(fmt::format("{}: the scanner{}{} sees no tube", name_of(id), scanner.empty() ? "" : " ", scanner));
  }

  SimulatedScene simulate_in_time(const Recipe& resolved, const CaseId& id) const {
    const Clock::time_point start = Clock::now();
    const auto expect_time = [&](double /*simulated*/) {
      if (Clock::now() - start > patience_)
        throw InputError({"", 0, name_of(id)},
                         fmt::format("no valid scene of {} tubes after {:.3g} s, when a dry run gives up",
                                     id.tubes, std::chrono::duration<double>(patience_).count()));
    };
    return simulate(
        resolved, id, [] {}, expect_time);
  }

  // Nothing of a case that has no valid recipe or scene, which fails in a dataset too.
  std::optional<MadeScene> make(const CaseId& id) {
    try {
      Recipe resolved = resolve(recipe_, id, draw(recipe_, id));
      for (const std::string& doubt : doubts(of_case_alone(resolved, id))) warn(doubt);
      SimulatedScene scene = simulate_in_time(resolved, id);
      return MadeScene{std::move(resolved), std::move(scene)};
    } catch (const InputError& error) {
      warn(fmt::format("{}: {}", name_of(id), error.problem()));
      return std::nullopt;
    }
  }

  void look(const MadeScene& made, const CaseId& id) {
    const auto& [recipe, scene] = made;
    look(scene.scan, recipe.scanner_name, id);
    for (std::size_t i = 0; i < scene.further_scans.size(); ++i)
      look(scene.further_scans[i], recipe.further_scanners[i].name, id);
  }

  Effort effort_of(const CaseId& id) {
    const Clock::time_point start = Clock::now();
    Effort effort;
    if (std::optional<MadeScene> made = make(id)) {
      effort.bytes = size_of(case_files(made->recipe, id, made->scene));
      look(*made, id);
      if (!result_.first) result_.first = std::move(made);
    }
    effort.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return effort;
  }

  const Recipe& recipe_;
  Clock::duration patience_;
  DryRun result_;
};

}  // namespace

DryRun dry_run(const Recipe& recipe, const std::vector<CaseId>& wanted, Clock::duration patience) {
  Trial trial(recipe, patience);
  for (const SetRecipe& set : recipe.sets) {
    std::vector<CaseId> of_set;
    std::ranges::copy_if(wanted, std::back_inserter(of_set),
                         [&](const CaseId& id) { return id.set == set.name; });
    if (!of_set.empty()) trial.estimate(of_set);
  }
  return trial.take();
}

}  // namespace tanglebin
