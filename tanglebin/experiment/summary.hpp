#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tanglebin/experiment/results.hpp"

namespace tanglebin {

/// The ratio at which the paper's Figure 8 compares numbers of tubes.
inline constexpr double figure_ratio = 0.3;

/// The ratio nearest to figure_ratio, of at least one; the smaller of two at the same distance.
double ratio_to_show(const std::vector<double>& ratios);

/// The mean over the cases with the same method, set, scanner and number of tubes.
struct MeanMicroRecall {
  std::string method;
  std::string set;
  std::string scanner;
  int tubes;
  std::size_t cases;
  std::size_t failed;  ///< of these: their micro-recall is 0, because nothing was found
  double mean;
};

/// How many runs have no score, at all ratios.
struct FailureCounts {
  std::size_t failed_runs = 0;     ///< that could not be modelled
  std::size_t cases_unscored = 0;  ///< without a visible tube
};

/// A run chosen to represent its method.
struct Example {
  std::string rank;  ///< "best", "median" or "worst"
  SeenCase seen;
  double micro_recall;
};

/// The score of a case.
struct ScoredCase {
  double micro_recall;
  SeenCase seen;
};

/// What results say at one ratio. Of each run there, it keeps a number and the case.
class ResultsSummary {
public:
  explicit ResultsSummary(double ratio) : ratio_(ratio) {}

  /// Adds the next result, in the order of the results.
  void add(const RunResult& result);

  double ratio() const { return ratio_; }

  /// The means at the ratio, in the order of the results. Cases without a visible tube do not count.
  const std::vector<MeanMicroRecall>& means() const { return means_; }

  /// At all ratios.
  FailureCounts failures() const;

  /// The runs with the highest, median and lowest micro-recall of a method at the ratio: the first of
  /// several, the lower of two medians. Empty if there are no such runs. Runs without a score do not count.
  std::vector<Example> examples(const std::string& method) const;

  /// The scores of a method at the ratio, in the order of the results. Runs without a score are left out.
  const std::vector<ScoredCase>& scores(const std::string& method) const;

private:
  double ratio_;
  std::vector<MeanMicroRecall> means_{};
  std::size_t failed_runs_ = 0;
  std::set<SeenCase> unscored_{};
  std::map<std::string, std::vector<ScoredCase>> scored_{};
};

/// The summary of a results directory at the ratio to show of these. Throws as for_each_result() does.
ResultsSummary summary_of(const std::filesystem::path& directory, const std::vector<double>& ratios);

/// The same of these cases alone.
ResultsSummary summary_of(const std::filesystem::path& directory, const std::vector<double>& ratios,
                          const std::vector<CaseId>& cases);

}  // namespace tanglebin
