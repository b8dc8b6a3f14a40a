#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tanglebin/experiment/results.hpp"

namespace tanglebin {

/// The ratio at which the paper's Figure 8 compares numbers of tubes.
inline constexpr double figure_ratio = 0.3;

/// The ratio nearest to figure_ratio, of at least one; the smaller of two at the same distance.
double ratio_to_show(const std::vector<double>& ratios);

/// The mean over the cases with the same method, set and number of tubes.
struct MeanMicroRecall {
  Method method;
  std::string set;
  int tubes;
  std::size_t cases;
  std::size_t failed;  ///< of these: their micro-recall is 0, because nothing was found
  double mean;
};

/// The means at one ratio, in the order of the results. Cases without a visible tube do not count.
std::vector<MeanMicroRecall> mean_micro_recalls(const std::vector<RunResult>& results, double ratio);

/// How many runs have no score, at all ratios.
struct FailureCounts {
  std::size_t failed_runs = 0;     ///< that could not be modelled
  std::size_t cases_unscored = 0;  ///< without a visible tube
};
FailureCounts count_failures(const std::vector<RunResult>& results);

/// A run chosen to represent its method.
struct Example {
  std::string rank;  ///< "best", "median" or "worst"
  RunResult result;
};

/// The runs with the highest, median and lowest micro-recall of a method at one ratio: the first of several,
/// the lower of two medians. Empty if there are no such runs. Runs without a score do not count.
std::vector<Example> examples(const std::vector<RunResult>& results, Method method, double ratio);

}  // namespace tanglebin
