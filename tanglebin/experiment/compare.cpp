#include "tanglebin/experiment/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/estimate.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/experiment/results.hpp"
#include "tanglebin/files/read_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

constexpr const char* unmixed_recall = "unmixed_recall";
constexpr const char* rand_index = "adjusted_rand_index";
constexpr std::array<const char*, 6> measure_names = {"micro_recall",     "mean_iou", "f1",
                                                      "panoptic_quality", rand_index, unmixed_recall};
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
using Measures = std::array<double, measure_names.size()>;

JsonRecord experiment_in(const fs::path& directory) {
  const fs::path file = directory / experiment_name;
  return {read_file(file), file.string(), 0};
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// The runs of a method on a scene, by scanner and ratio.
struct SceneRuns {
  std::string case_sha256;
  std::map<std::pair<std::string, double>, Measures> runs;
};

/// A method's runs.
struct Scenes {
  std::map<CaseId, SceneRuns> by_id;
  bool have_mixed = false;  ///< some clouds mark mixed points
};

std::optional<double> unmixed_recall_of(const RunResult& result, const JsonRecord& record) {
  if (result.failure || !record.has(unmixed_recall)) return std::nullopt;
  return record.number_or_null(unmixed_recall, 0, 1);
}

double measure_of(const RunResult& result, const JsonRecord& record, const char* name) {
  if (name == rand_index && result.run.scene.tubes == 1) return undefined;
  if (result.failure) return 0;
  if (name == rand_index) return record.number_or_null(name, -1, 1).value_or(undefined);
  return record.number(name, -1, 1);
}

// Where no points are marked as mixed, the micro-recall is that without them.
Measures measures_of(const RunResult& result, const JsonRecord& record) {
  Measures measures{};
  for (std::size_t i = 0; i + 1 < measures.size(); ++i)
    measures[i] = measure_of(result, record, measure_names[i]);
  measures.back() = unmixed_recall_of(result, record).value_or(measures.front());
  return measures;
}

Scenes scenes_of(const Contestant& contestant) {
  if (!has(experiment_in(contestant.results).texts("methods"), contestant.method))
    throw InputError({contestant.results.string(), 0, "method"}, excerpt(contestant.method),
                     "one of its methods");
  Scenes scenes;
  for_each_result(contestant.results, [&](const RunResult& result, const JsonRecord& record) {
    const bool is_unscored = result.failure && result.failure->of == FailureOf::scene;
    if (result.run.method != contestant.method || is_unscored) return;
    SceneRuns& scene = scenes.by_id[result.run.scene];
    scene.case_sha256 = result.case_sha256;
    scene.runs[{result.run.scanner, result.run.ratio}] = measures_of(result, record);
    scenes.have_mixed |= unmixed_recall_of(result, record).has_value();
  });
  return scenes;
}

/// The means of a scene over the scanners and ratios that both sides have.
struct Pair {
  CaseId scene;
  Measures baseline;
  Measures other;
};

void add(Measures& sum, const Measures& measures) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += measures[i];
}

void divide(Measures& sum, std::size_t count) {
  for (double& value : sum) value /= static_cast<double>(count);
}

std::optional<Pair> paired(const CaseId& id, const SceneRuns& baseline, const SceneRuns& other) {
  Pair pair{id, {}, {}};
  std::size_t count = 0;
  for (const auto& [view, measures] : baseline.runs) {
    const auto found = other.runs.find(view);
    if (found == other.runs.end()) continue;
    add(pair.baseline, measures);
    add(pair.other, found->second);
    ++count;
  }
  if (count == 0) return std::nullopt;
  divide(pair.baseline, count);
  divide(pair.other, count);
  return pair;
}

std::size_t count_runs(const Scenes& scenes) {
  std::size_t count = 0;
  for (const auto& [id, scene] : scenes.by_id) count += scene.runs.size();
  return count;
}

std::size_t count_common_runs(const SceneRuns& a, const SceneRuns& b) {
  return static_cast<std::size_t>(
      std::ranges::count_if(a.runs, [&](const auto& run) { return b.runs.contains(run.first); }));
}

double mean(const std::vector<Pair>& pairs, Measures Pair::*side, std::size_t measure) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += (pair.*side)[measure];
  return sum / static_cast<double>(pairs.size());
}

std::vector<Pair> pairs_with(std::vector<Pair> pairs, std::size_t measure) {
  std::erase_if(pairs, [&](const Pair& pair) {
    return std::isnan(pair.baseline[measure]) || std::isnan(pair.other[measure]);
  });
  return pairs;
}

std::vector<double> differences_of(const std::vector<Pair>& pairs, std::size_t measure) {
  std::vector<double> differences;
  differences.reserve(pairs.size());
  for (const Pair& pair : pairs) differences.push_back(pair.other[measure] - pair.baseline[measure]);
  return differences;
}

std::vector<MeasureDifference> measure_differences(const std::vector<Pair>& pairs, bool have_mixed) {
  std::vector<MeasureDifference> differences;
  for (std::size_t i = 0; i < measure_names.size(); ++i) {
    if (measure_names[i] == unmixed_recall && !have_mixed) continue;
    const std::vector<Pair> measured = pairs_with(pairs, i);
    if (measured.empty()) continue;
    const double baseline = mean(measured, &Pair::baseline, i);
    const double other = mean(measured, &Pair::other, i);
    const Estimate estimate = estimate_of_mean(differences_of(measured, i));
    differences.push_back({measure_names[i], baseline, other, other - baseline, estimate.low, estimate.high});
  }
  return differences;
}

// Those for which `is_wanted` holds of the difference, the greatest first.
template <typename IsWanted>
std::vector<SceneDifference> scenes_that_differ(const std::vector<Pair>& pairs, const IsWanted& is_wanted) {
  std::vector<SceneDifference> scenes;
  for (const Pair& pair : pairs) {
    const SceneDifference scene{pair.scene, pair.baseline.front(), pair.other.front()};
    if (is_wanted(scene.difference())) scenes.push_back(scene);
  }
  std::ranges::stable_sort(scenes, std::ranges::greater(),
                           [](const SceneDifference& scene) { return std::abs(scene.difference()); });
  return scenes;
}

using Pairs = std::vector<std::pair<Contestant, Contestant>>;

Pairs pairs_within(const fs::path& results, const std::optional<std::string>& baseline) {
  const std::vector<std::string> methods = experiment_in(results).texts("methods");
  const std::string first = baseline.value_or(methods.empty() ? "" : methods.front());
  if (!has(methods, first))
    throw InputError({"", 0, "baseline"}, excerpt(first),
                     fmt::format("a method of {}: {}", results.string(), fmt::join(methods, ", ")));
  Pairs pairs;
  for (const std::string& method : methods) {
    if (method != first) pairs.push_back({{results, first}, {results, method}});
  }
  return pairs;
}

// With that of a name, or all of the first directory's.
Pairs pairs_between(const fs::path& results, const fs::path& other,
                    const std::optional<std::string>& baseline) {
  const JsonRecord experiment = experiment_in(results);
  const JsonRecord its_experiment = experiment_in(other);
  if (experiment.text("recipe_sha256") != its_experiment.text("recipe_sha256"))
    throw InputError({other.string(), 0, "recipe_sha256"}, "results of another dataset");
  const std::vector<std::string> methods = experiment.texts("methods");
  const std::vector<std::string> its_methods = its_experiment.texts("methods");
  Pairs pairs;
  for (const std::string& method : methods) {
    const bool is_wanted = !baseline || method == *baseline;
    if (is_wanted && has(its_methods, method)) pairs.push_back({{results, method}, {other, method}});
  }
  if (pairs.empty() && methods.size() == 1 && its_methods.size() == 1)
    pairs.push_back({{results, methods.front()}, {other, its_methods.front()}});
  return pairs;
}

}  // namespace

std::vector<std::pair<Contestant, Contestant>> pairs_to_compare(const std::vector<fs::path>& results,
                                                                const std::optional<std::string>& baseline) {
  if (results.empty()) throw InputError({"", 0, "results"}, "none", "the directory of one or more results");
  Pairs pairs;
  if (results.size() == 1) pairs = pairs_within(results.front(), baseline);
  for (std::size_t i = 1; i < results.size(); ++i) {
    const Pairs more = pairs_between(results.front(), results[i], baseline);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  if (pairs.empty()) throw InputError({results.front().string(), 0, ""}, "no two methods to compare");
  return pairs;
}

Comparison compare(const Contestant& baseline, const Contestant& other) {
  Comparison comparison{.baseline = baseline, .other = other};
  const Scenes scenes = scenes_of(baseline);
  const Scenes other_scenes = scenes_of(other);
  std::vector<Pair> pairs;
  std::size_t common_runs = 0;
  for (const auto& [id, scene] : scenes.by_id) {
    const auto found = other_scenes.by_id.find(id);
    if (found == other_scenes.by_id.end()) continue;
    if (scene.case_sha256 != found->second.case_sha256)
      throw InputError({other.results.string(), 0, name_of(id)},
                       "another scene than in " + baseline.results.string());
    common_runs += count_common_runs(scene, found->second);
    if (const auto pair = paired(id, scene, found->second)) pairs.push_back(*pair);
  }
  if (pairs.empty())
    throw InputError({other.results.string(), 0, other.method},
                     "no scene in common with " + baseline.method + " in " + baseline.results.string());
  comparison.scenes = pairs.size();
  comparison.unpaired = count_runs(scenes) + count_runs(other_scenes) - 2 * common_runs;
  comparison.measures = measure_differences(pairs, scenes.have_mixed || other_scenes.have_mixed);
  comparison.better = scenes_that_differ(pairs, [](double difference) { return difference > 0; });
  comparison.worse = scenes_that_differ(pairs, [](double difference) { return difference < 0; });
  return comparison;
}

}  // namespace tanglebin
