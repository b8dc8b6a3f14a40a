#pragma once

#include <string>

#include "tanglebin/report/results.hpp"

// The sections of the report, in order, as HTML. Each says what the results lack.
namespace tanglebin {

/// What was run, with the headline numbers.
std::string overview(const Results& results);

/// Each method's mean micro-recall, the best first: of all scenes, by set, by scanner and by number of tubes.
std::string leaderboard(const Results& results);

/// Table 1: generation time of cases, by number of tubes.
std::string generation_times(const Results& results);

/// Table 2: modelling time, by ratio and number of tubes.
std::string modelling_times(const Results& results);

/// Figure 8: micro-recall by number of tubes, at one ratio.
std::string recall_by_tubes(const Results& results);

/// Figure 9: micro-recall by ratio, for one number of tubes.
std::string recall_by_ratio(const Results& results);

/// The measures besides micro-recall, by number of tubes.
std::string other_measures(const Results& results);

/// Every run, to sort, filter and plot.
std::string all_runs(const Results& results);

/// The scenes that are there in 3D.
std::string scenes_in_3d(const Results& results);

/// The best, median and worst cases, with their true and their modelled labels.
std::string example_pictures(const Results& results);

/// The commands that reproduce these results and the page, a file of this name.
std::string how_to_repeat(const Results& results, const std::string& page);

}  // namespace tanglebin
