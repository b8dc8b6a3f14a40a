#include "tanglebin/experiment/summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace tanglebin {
namespace {

bool is_unscored(const RunResult& result) {
  return result.failure && result.failure->of == FailureOf::scene;
}

}  // namespace

double ratio_to_show(const std::vector<double>& ratios) {
  return std::ranges::min(ratios, {}, [](double ratio) {
    // Compares in billionths: 0.2 and 0.4 are equally near to 0.3, but the differences of the doubles are not
    // equal.
    constexpr double billion = 1e9;
    return std::llround(std::abs(ratio - figure_ratio) * billion);
  });
}

std::vector<MeanMicroRecall> mean_micro_recalls(const std::vector<RunResult>& results, double ratio) {
  std::vector<MeanMicroRecall> means;
  for (const RunResult& result : results) {
    if (result.run.ratio != ratio || is_unscored(result)) continue;
    const Method method = result.run.method;
    const CaseId& id = result.run.scene;
    auto mean = std::ranges::find_if(means, [&](const MeanMicroRecall& other) {
      return other.method == method && other.set == id.set && other.tubes == id.tubes;
    });
    if (mean == means.end()) mean = means.insert(mean, {method, id.set, id.tubes, 0, 0, 0.0});
    ++mean->cases;
    if (result.failure) ++mean->failed;
    mean->mean += (result.micro_recall - mean->mean) / static_cast<double>(mean->cases);
  }
  return means;
}

FailureCounts count_failures(const std::vector<RunResult>& results) {
  FailureCounts counts;
  std::set<CaseId> unscored;
  for (const RunResult& result : results) {
    if (is_unscored(result)) {
      unscored.insert(result.run.scene);
    } else if (result.failure) {
      ++counts.failed_runs;
    }
  }
  counts.cases_unscored = unscored.size();
  return counts;
}

std::vector<Example> examples(const std::vector<RunResult>& results, Method method, double ratio) {
  std::vector<RunResult> runs;
  std::ranges::copy_if(results, std::back_inserter(runs), [&](const RunResult& result) {
    return result.run.method == method && result.run.ratio == ratio && !result.failure;
  });
  if (runs.empty()) return {};
  std::ranges::stable_sort(runs, {}, &RunResult::micro_recall);
  const auto best = std::ranges::lower_bound(runs, runs.back().micro_recall, {}, &RunResult::micro_recall);
  return {{"best", *best}, {"median", runs[(runs.size() - 1) / 2]}, {"worst", runs.front()}};
}

}  // namespace tanglebin
