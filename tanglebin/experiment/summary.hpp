#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tanglebin/experiment/results.hpp"

namespace tanglebin {

/// The ratio that the paper's Figure 8 compares numbers of tubes at.
inline constexpr double figure_ratio = 0.3;

/// The one of the ratios (at least one) that is nearest to figure_ratio; of two, the smaller.
double ratio_to_show(const std::vector<double>& ratios);

/// The mean over the cases of one method, set and number of tubes.
struct MeanMicroRecall {
  Method method;
  std::string set;
  int tubes;
  std::size_t cases;
  double mean;
};

/// The means at one ratio, in the order of the results.
std::vector<MeanMicroRecall> mean_micro_recalls(const std::vector<RunResult>& results, double ratio);

/// A run that stands for its method.
struct Example {
  std::string rank;  ///< "best", "median" or "worst"
  RunResult result;
};

/// The runs of the highest, median and lowest micro-recall of a method at one ratio; of several the first, of
/// two medians the lower. None where there are no such runs.
std::vector<Example> examples(const std::vector<RunResult>& results, Method method, double ratio);

}  // namespace tanglebin
