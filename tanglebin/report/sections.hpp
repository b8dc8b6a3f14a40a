#pragma once

#include <string>

#include "tanglebin/report/results.hpp"

// The sections of the report, in its order: HTML. What the results lack is said in its place.
namespace tanglebin {

/// What was run, and the headline numbers.
std::string overview(const Results& results);

/// Table 1: how long cases took to generate, by number of tubes.
std::string generation_times(const Results& results);

/// Table 2: how long the tubes took to model, by ratio and number of tubes.
std::string modelling_times(const Results& results);

/// Figure 8: micro-recall by number of tubes, at one ratio.
std::string recall_by_tubes(const Results& results);

/// Figure 9: micro-recall by ratio, for one number of tubes.
std::string recall_by_ratio(const Results& results);

/// The measures beside micro-recall, by number of tubes.
std::string other_measures(const Results& results);

/// The best, the median and the worst case, as they are and as they were labelled.
std::string example_pictures(const Results& results);

/// The commands that give these results and this page.
std::string how_to_repeat(const Results& results);

}  // namespace tanglebin
