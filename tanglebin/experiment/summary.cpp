#include "tanglebin/experiment/summary.hpp"

#include <algorithm>
#include <cmath>

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

void ResultsSummary::add(const RunResult& result) {
  const RunId& run = result.run;
  if (is_unscored(result)) {
    unscored_.insert(seen_case(run));
    return;
  }
  if (result.failure) ++failed_runs_;
  if (run.ratio != ratio_) return;
  auto mean = std::ranges::find_if(means_, [&run](const MeanMicroRecall& other) {
    return other.method == run.method && other.set == run.scene.set && other.scanner == run.scanner &&
           other.tubes == run.scene.tubes;
  });
  if (mean == means_.end())
    mean = means_.insert(mean, {run.method, run.scene.set, run.scanner, run.scene.tubes, 0, 0, 0.0});
  ++mean->cases;
  if (result.failure) ++mean->failed;
  mean->mean += (result.micro_recall - mean->mean) / static_cast<double>(mean->cases);
  if (!result.failure) scored_[run.method].push_back({result.micro_recall, seen_case(run)});
}

FailureCounts ResultsSummary::failures() const {
  return {failed_runs_, unscored_.size()};
}

std::vector<Example> ResultsSummary::examples(const std::string& method) const {
  std::vector<ScoredCase> runs = scores(method);
  if (runs.empty()) return {};
  std::ranges::stable_sort(runs, {}, &ScoredCase::micro_recall);
  const auto example = [](const char* rank, const ScoredCase& run) {
    return Example{rank, run.seen, run.micro_recall};
  };
  const auto best = std::ranges::lower_bound(runs, runs.back().micro_recall, {}, &ScoredCase::micro_recall);
  return {example("best", *best), example("median", runs[(runs.size() - 1) / 2]),
          example("worst", runs.front())};
}

const std::vector<ScoredCase>& ResultsSummary::scores(const std::string& method) const {
  static const std::vector<ScoredCase> none;
  const auto found = scored_.find(method);
  return found == scored_.end() ? none : found->second;
}

ResultsSummary summary_of(const std::filesystem::path& directory, const std::vector<double>& ratios) {
  ResultsSummary summary(ratio_to_show(ratios));
  for_each_result(directory, [&](const RunResult& result, const JsonRecord&) { summary.add(result); });
  return summary;
}

ResultsSummary summary_of(const std::filesystem::path& directory, const std::vector<double>& ratios,
                          const std::vector<CaseId>& cases) {
  const std::set<CaseId> wanted(cases.begin(), cases.end());
  ResultsSummary summary(ratio_to_show(ratios));
  for_each_result(directory, [&](const RunResult& result, const JsonRecord&) {
    if (wanted.contains(result.run.scene)) summary.add(result);
  });
  return summary;
}

}  // namespace tanglebin
